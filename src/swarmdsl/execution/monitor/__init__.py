"""Monitors of properties, deterministic automata with clocks, and gauges of measures.

Standard library only, and nothing else of swarmdsl, so that generated packages can carry them.
A `Watch` turns the lines of a run into the truth of claims; a `Monitor` gets the truth of each
claim at each step, and knows nothing of robots.
"""

from .claims import Claim, Count, Fact, Junction, Measure, Property, Robots
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
from .meters import Gauge, Meter, Reading, aggregated
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
    "Gauge",
    "Has",
    "Interest",
    "Junction",
    "LineLike",
    "Measure",
    "Meter",
    "Monitor",
    "Pattern",
    "Property",
    "PropertyResult",
    "Reading",
    "RobotLike",
    "Robots",
    "Route",
    "Sentence",
    "Verdict",
    "ViolatedError",
    "Violation",
    "Watch",
    "aggregated",
    "can_hold",
    "meant_states",
    "pattern_of",
    "test_of",
]
