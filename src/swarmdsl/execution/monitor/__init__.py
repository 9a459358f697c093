"""Monitors of properties, deterministic automata with clocks, and gauges of measures.

Standard library only, and nothing else of swarmdsl, so that generated packages can carry them.
A `Watch` turns the lines of a run into the truth of claims; a `Monitor` gets the truth of each
claim at each step, and knows nothing of robots.
"""

from .automaton import Automaton
from .claims import Claim, Count, Fact, Junction, Measure, Property, Robots
from .facts import (
    LOST,
    MOMENTARY,
    ActorLike,
    Facts,
    Has,
    Kind,
    LineLike,
    RobotLike,
    can_hold,
    meant_states,
)
from .meters import Gauge, Meter, Reading, aggregated
from .monitor import FALSE, OPEN, TRUE, Monitor, Sentence, Verdict
from .outcomes import PropertyResult, ViolatedError, Violation
from .patterns import Pattern, pattern_of
from .plan import Plan
from .watch import Watch

__all__ = [
    "FALSE",
    "LOST",
    "MOMENTARY",
    "OPEN",
    "TRUE",
    "ActorLike",
    "Automaton",
    "Claim",
    "Count",
    "Fact",
    "Facts",
    "Gauge",
    "Has",
    "Junction",
    "Kind",
    "LineLike",
    "Measure",
    "Meter",
    "Monitor",
    "Pattern",
    "Plan",
    "Property",
    "PropertyResult",
    "Reading",
    "RobotLike",
    "Robots",
    "Sentence",
    "Verdict",
    "ViolatedError",
    "Violation",
    "Watch",
    "aggregated",
    "can_hold",
    "meant_states",
    "pattern_of",
]
