"""Monitors of properties: deterministic automata with clocks, one for each property.

Standard library only, and nothing else of swarmdsl, so that generated packages can carry them.
A `Watch` turns the lines of a run into the truth of claims; a `Monitor` gets the truth of each
claim at each step, and knows nothing of robots.
"""

from .claims import Claim, Count, Fact, Junction, Property, Robots
from .facts import (
    LOST,
    MOMENTARY,
    ActorLike,
    FactTracker,
    Has,
    LineLike,
    RobotLike,
    Route,
    can_hold,
    meant_states,
    test_of,
)
from .monitor import FALSE, OPEN, TRUE, Monitor, Sentence, Verdict
from .patterns import Pattern, pattern_of
from .watch import Interest, PropertyResult, ViolatedError, Violation, Watch

__all__ = [
    "FALSE",
    "LOST",
    "MOMENTARY",
    "OPEN",
    "TRUE",
    "ActorLike",
    "Claim",
    "Count",
    "Fact",
    "FactTracker",
    "Has",
    "Interest",
    "Junction",
    "LineLike",
    "Monitor",
    "Pattern",
    "Property",
    "PropertyResult",
    "RobotLike",
    "Robots",
    "Route",
    "Sentence",
    "Verdict",
    "ViolatedError",
    "Violation",
    "Watch",
    "can_hold",
    "meant_states",
    "pattern_of",
    "test_of",
]
