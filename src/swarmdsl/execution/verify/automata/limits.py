"""Limits of searches: states, time and memory."""

from __future__ import annotations

import resource
import sys
import time
from collections.abc import Callable

from swarmdsl.base.records import dataclass, replace

_KILOBYTES = 1 if sys.platform == "darwin" else 1024
"""Bytes in the unit of `ru_maxrss`."""
_FEW = 4096
"""Number of states that a search may find whatever the memory is."""
_MOMENT = 0.3
"""Seconds after the end in which runs to what was found are tried."""


def _used() -> int:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * _KILOBYTES


@dataclass(frozen=True)
class Limits:
    """Limits of a search: states, seconds, and bytes of memory; None is no limit."""

    states: int = 1_000_000
    seconds: float | None = None
    memory: int | None = None


class LimitReachedError(Exception):
    """The time is over, or the user has interrupted: what was begun is left."""


class Budget:
    """Rest of the limits of a command.

    `tell` is called with the number of states from time to time.
    """

    def __init__(
        self,
        limits: Limits,
        tell: Callable[[int], None] | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._limits = limits
        self._tell = tell
        self._clock = clock
        self._began = clock()
        self._ended: float | None = None
        self._whole = self
        self._is_interrupted = False
        self.reached = "states"
        """The limit that ended the last search that did not find all states."""

    @property
    def interrupted(self) -> bool:
        """True if the user has ended all searches."""
        return self._whole._is_interrupted

    def interrupt(self) -> None:
        """End all searches soon."""
        self._whole._is_interrupted = True

    def is_over(self) -> bool:
        """Return True if the time is over, or the user has interrupted."""
        seconds = self._limits.seconds
        is_late = seconds is not None and self._clock() - self._began >= seconds
        if is_late:
            self.reached = "time"
        if (is_late or self.interrupted) and self._ended is None:
            self._ended = self._clock()
        return is_late or self.interrupted

    def check(self) -> None:
        """Raise LimitReachedError if the time is over, or the user has interrupted."""
        if self.is_over():
            raise LimitReachedError

    def spares_a_moment(self) -> bool:
        """Return True until a moment after the end, in which what was found is shown."""
        if not self.is_over():
            return True
        assert self._ended is not None
        return self._clock() - self._ended < _MOMENT

    def allows(self, states: int) -> bool:
        """Return True if a search may go on."""
        limits = self._limits
        if self._tell is not None:
            self._tell(states)
        if states > limits.states or self.is_over():
            return False
        # Few states take no memory that a larger search before them has not taken.
        if limits.memory is None or 0 < states < _FEW or _used() < limits.memory:
            return True
        self.reached = "memory"
        return False

    def some(self, states: int) -> Budget:
        """Return the limits of a search for something near, which few states show."""
        some = Budget(replace(self._limits, states=min(states, self.most)), self._tell)
        some._clock, some._began, some._whole = self._clock, self._began, self._whole
        return some

    @property
    def most(self) -> int:
        """Number of states that one search may find."""
        return self._limits.states
