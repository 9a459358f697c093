"""Stand-in for the engine, which generated packages get from `swarmdsl.execution.engine`."""

from swarmdsl.execution.engine import (
    bounded,
    Envelope,
    Event,
    ExecutionError,
    Instance,
    LoopError,
    Machine,
    Observer,
    Run,
    Servers,
)
from swarmdsl.execution.engine.world import FAILURES as _FAILURES

FAILURES: tuple[type[Exception], ...] = _FAILURES

__all__ = (
    'FAILURES',
    'Envelope',
    'Event',
    'ExecutionError',
    'Instance',
    'LoopError',
    'Machine',
    'Observer',
    'Run',
    'Servers',
    'bounded',
)
