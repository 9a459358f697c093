"""Times of the steps of a run: a system of difference constraints (R. Bellman, 1958)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from swarmdsl.execution.simulate.scenario.durations import MILLISECOND, SECOND
from swarmdsl.execution.verify.robot.timing import Bounds

_MOST_ROUNDS = 50
"""Number of times that losses are moved to a heartbeat."""

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


class Beats(NamedTuple):
    """Steps at which robots are lost that others hear of, and the time between two heartbeats."""

    steps: tuple[int, ...]
    period: int


def in_step(
    times_with: Callable[[Sequence[Constraint]], list[int] | None], beats: Beats | None
) -> list[int] | None:
    """Return times for which robots are lost at a heartbeat: they are missed after the timeout.

    `times_with` returns the least times that fit more constraints.
    """
    if beats is None:
        return times_with(())
    more: list[Constraint] = []
    for _ in range(_MOST_ROUNDS):
        times = times_with(more)
        if times is None:
            return None
        early = [(step, -times[step] % beats.period) for step in beats.steps]
        if not any(wait for _, wait in early):
            return times
        more += [(step, 0, times[step] + wait) for step, wait in early if wait]
    return None


def fitting(steps: int, constraints: Sequence[Constraint]) -> list[int] | None:
    """Return times of the steps that fit, with pauses between them where that is possible."""
    for gaps in _pauses(steps, constraints):
        every = [(n + 1, n, gap) for n, gap in enumerate(gaps)] + list(constraints)
        times = _least(steps, every)
        if times is not None:
            return times
    return None


def _pauses(steps: int, constraints: Sequence[Constraint]) -> Iterator[list[int]]:
    """Yield pauses after each step: equal ones, then only those that fit between other steps."""
    for gap in GAPS[:-1]:
        yield [gap] * steps
    for gap in GAPS[:-1]:
        gaps = [gap] * steps
        for later, earlier, least in constraints:
            if later < earlier and gap * (earlier - later) > -least:
                gaps[later:earlier] = [0] * (earlier - later)
        yield gaps
    yield [0] * steps


def _least(steps: int, constraints: Sequence[Constraint]) -> list[int] | None:
    times = [0] * (steps + 1)
    for _ in range(steps + 2):
        changed = False
        for later, earlier, least in constraints:
            if times[earlier] + least > times[later]:
                times[later] = times[earlier] + least
                changed = True
        if not changed:
            return times if times[0] == 0 else None
    return None
