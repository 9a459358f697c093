"""The state machine engine: what a machine means, wherever it runs.

SCXML 1.0, Appendix D, over tables of plain data (`Machine`). An `Instance` of one runs in a
`World`, which has the clock and the servers of activities; nothing here reads the time or
knows of threads. Needs the standard library of Python 3.8 only, and nothing else of swarmdsl,
because generated packages get a copy.
"""

from .activity import Run, Servers
from .configuration import Configuration
from .instance import Instance
from .table import (
    Activity,
    Effect,
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
    "Activity",
    "Configuration",
    "Effect",
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
    "bounded",
]
