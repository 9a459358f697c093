"""Holds: time stands until the nodes have done what is known to follow at once."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable

PATIENCE = 1.0
"""Real time for which the clock stands at most, in seconds."""
Key = tuple[str, ...]


class Holds:
    """Expected acts of nodes, by kind.

    Without it the time of the world would go on while a message is under way, and on a busy machine
    the nodes would act late in this time.
    """

    def __init__(self, now: Callable[[], float] = time.monotonic) -> None:
        self.given_up = 0
        """Number of times that the clock went on although something was missing."""
        self._now = now
        self._missing: Counter[Key] = Counter()
        self._since: float | None = None

    def expect(self, *key: str) -> None:
        """Expect something, unless it has come already."""
        self._missing[key] += 1
        self._since = self._now()

    def came(self, *key: str, early: bool = False) -> None:
        """Note that something has come; what comes `early` is expected later."""
        if early or self._missing[key] > 0:
            self._missing[key] -= 1

    @property
    def is_waiting(self) -> bool:
        """True while something is missing, and the patience has not ended."""
        if not any(count > 0 for count in self._missing.values()):
            return False
        assert self._since is not None
        if self._now() - self._since < PATIENCE:
            return True
        self.given_up += 1
        self._missing.clear()
        return False
