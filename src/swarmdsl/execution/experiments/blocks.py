"""Blocks of seeds: tasks that are long enough to be worth their way to a worker.

Their size depends on how long runs take, and so changes from run to run. Results do not depend
on it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

LEAST = 0.1
"""Seconds that a task takes at least."""
_MOST = 1000
_FIRST = 2
"""Runs in the first blocks, of which nothing is known."""
_WEIGHT = 0.3


class Pace:
    """Time of a run, and the number that go best together, by kind of runs."""

    def __init__(self) -> None:
        self._seconds: dict[str, float] = {}
        self._batch: dict[str, int] = {}

    def note(self, kind: str, runs: int, seconds: float, batch: int) -> None:
        """Note how long some runs took."""
        each = seconds / runs
        before = self._seconds.get(kind, each)
        self._seconds[kind] = before + _WEIGHT * (each - before)
        self._batch[kind] = batch

    def size(self, kind: str) -> int:
        """Return the number of runs of a task."""
        each = self._seconds.get(kind)
        if each is None:
            return _FIRST
        enough = math.ceil(LEAST / each) if each > 0 else _MOST
        return min(max(enough, self._batch[kind]), _MOST)


def cut(seeds: Sequence[int], size: int) -> tuple[list[int], list[int]]:
    """Return the seeds of the next block and the others; blocks are of nearly equal sizes."""
    blocks = math.ceil(len(seeds) / size)
    length = math.ceil(len(seeds) / blocks)
    return list(seeds[:length]), list(seeds[length:])
