"""State machine engine: the semantics of machines on every platform.

It implements SCXML 1.0, Appendix D, on tables of plain data (`Machine`). An `Instance` of a
machine runs in a `World`, which has the clock and the servers of activities; the engine never
reads the time and knows no threads. It needs the standard library of Python 3.8 only, and nothing
else of swarmdsl, because generated packages contain a copy.
"""

from .activity import Run, Servers
from .arrays import appended, item, removed, replaced
from .configuration import Configuration
from .instance import Instance
from .table import (
    NO_ENVELOPE,
    Activity,
    Effect,
    Envelope,
    Event,
    Guard,
    InstanceLike,
    Kind,
    Machine,
    State,
    TableError,
    Transition,
)
from .world import ExecutionError, LoopError, Observer, World, bounded

__all__ = [
    "NO_ENVELOPE",
    "Activity",
    "Configuration",
    "Effect",
    "Envelope",
    "Event",
    "ExecutionError",
    "Guard",
    "Instance",
    "InstanceLike",
    "Kind",
    "LoopError",
    "Machine",
    "Observer",
    "Run",
    "Servers",
    "State",
    "TableError",
    "Transition",
    "World",
    "appended",
    "bounded",
    "item",
    "removed",
    "replaced",
]
