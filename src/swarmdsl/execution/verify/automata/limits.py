"""Limits of searches: states, time and memory."""

from __future__ import annotations

import resource
import sys
import time
from collections.abc import Callable

from swarmdsl.base.records import dataclass, replace

_KILOBYTES = 1 if sys.platform == "darwin" else 1024
"""Bytes in the unit of `ru_maxrss`."""


def _used() -> int:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * _KILOBYTES


@dataclass(frozen=True)
class Limits:
    """Limits of a search: states, seconds, and bytes of memory; None is no limit."""

    states: int = 1_000_000
    seconds: float | None = None
    memory: int | None = None


class Budget:
    """Rest of the limits of a command.

    `tell` is called with the number of states from time to time.
    """

    def __init__(self, limits: Limits, tell: Callable[[int], None] | None = None) -> None:
        self._limits = limits
        self._tell = tell
        self._began = time.monotonic()
        self.interrupted = False
        self.reached = "states"
        """The limit that ended the last search that did not find all states."""

    def allows(self, states: int) -> bool:
        """Return True if a search may go on."""
        limits = self._limits
        if self._tell is not None:
            self._tell(states)
        if self.interrupted or states >= limits.states:
            return False
        if limits.seconds is not None and time.monotonic() - self._began >= limits.seconds:
            self.reached = "time"
            return False
        # The system takes its time to tell.
        if limits.memory is None or _used() < limits.memory:
            return True
        self.reached = "memory"
        return False

    def some(self, states: int) -> Budget:
        """Return the limits of a search for something near, which few states show."""
        some = Budget(replace(self._limits, states=min(states, self.most)), self._tell)
        some._began = self._began
        some.interrupted = self.interrupted
        return some

    @property
    def most(self) -> int:
        """Number of states that one search may find."""
        return self._limits.states
