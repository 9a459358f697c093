"""Times of the steps of a run: a system of difference constraints (R. Bellman, 1958)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl.execution.simulate.durations import MILLISECOND, SECOND
from swarmdsl.execution.verify.timing import Bounds

GAPS = (SECOND, MILLISECOND, 0)
"""Times between two steps, the preferred one first."""
Constraint = tuple[int, int, int]
"""Later step, earlier step, and the least difference between their times."""


def limits(bounds: Bounds, began: int, ended: int, *, is_over: bool) -> Iterator[Constraint]:
    """Yield constraints on what began at a step and is not over before another one."""
    least, most = bounds
    if is_over:
        yield ended, began, least
    if most is not None:
        yield began, ended, -most


def fitting(steps: int, constraints: Sequence[Constraint]) -> list[int] | None:
    """Return times of the steps that fit, with pauses between them if possible."""
    for gap in GAPS:
        every = [(n + 1, n, gap) for n in range(steps)] + list(constraints)
        times = [0] * (steps + 1)
        for _ in range(steps + 2):
            changed = False
            for later, earlier, least in every:
                if times[earlier] + least > times[later]:
                    times[later] = times[earlier] + least
                    changed = True
            if not changed:
                break
        else:
            continue
        if times[0] == 0:
            return times
    return None
