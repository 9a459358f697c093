"""Times of a run that goes on in laps of equal length: difference constraints with a parameter.

For each length of a lap, they are a system of difference constraints (R. Bellman, 1958). A cycle
of constraints that cannot be kept tells the length that the lap must have at least.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from swarmdsl.execution.simulate.scenario.durations import MILLISECOND
from swarmdsl.execution.verify.replay.times import GAPS

_MOST_LENGTHS = 100


class _Edge(NamedTuple):
    """The time of `later` is that of `earlier`, `least` and some `laps` at least."""

    later: int
    earlier: int
    least: int
    laps: int = 0


def lap_times(
    before: int, steps: int, constraints: Sequence[tuple[int, int, int]]
) -> list[int] | None:
    """Return the times of the steps of a run and of its first lap, and the length of a lap.

    `before` is the number of steps before the laps, `steps` that of each. The constraints are
    about two laps, as (later, earlier, least difference). Return None if no times fit.
    """
    end = before + steps
    for gap in GAPS:
        every = [_Edge(n + 1, n, gap) for n in range(end)]
        # The next lap begins after this one.
        every.append(_Edge(before + 1, end, gap, -1))
        every += _in_laps(before, steps, constraints)
        found = _fit(end, every, max(gap * steps, MILLISECOND))
        if found is not None:
            return found
    return None


def _in_laps(
    before: int, steps: int, constraints: Sequence[tuple[int, int, int]]
) -> Iterator[_Edge]:
    """Yield constraints about the first lap; what begins in the second one is the same."""
    end = before + steps
    for later, earlier, least in constraints:
        if later > end and earlier > end:
            continue
        laps = (earlier > end) - (later > end)
        yield _Edge(later - steps * (later > end), earlier - steps * (earlier > end), least, laps)


def _fit(end: int, every: Sequence[_Edge], length: int) -> list[int] | None:
    """Return the least times and lengths that fit: a shorter lap than a given one cannot."""
    for _ in range(_MOST_LENGTHS):
        times, cycle = _times(end, every, length)
        if cycle is None:
            return [*times, length] if times[0] == 0 else None
        least, laps = sum(edge.least for edge in cycle), sum(edge.laps for edge in cycle)
        if laps >= 0:
            return None
        length = -(least // laps)
    return None


def _times(
    end: int, every: Sequence[_Edge], length: int
) -> tuple[list[int], Sequence[_Edge] | None]:
    """Return the least times for a length, or a cycle of constraints that cannot be kept."""
    times = [0] * (end + 1)
    last: list[_Edge | None] = [None] * (end + 1)
    changed: int | None = None
    for _ in range(end + 2):
        changed = None
        for edge in every:
            time = times[edge.earlier] + edge.least + edge.laps * length
            if time > times[edge.later]:
                times[edge.later] = time
                last[edge.later] = edge
                changed = edge.later
        if changed is None:
            return times, None
    return times, _cycle(last, changed)


def _cycle(last: Sequence[_Edge | None], node: int | None) -> list[_Edge]:
    """Return the cycle of edges that led to a node."""
    assert node is not None
    for _ in last:
        edge = last[node]
        assert edge is not None
        node = edge.earlier
    found = []
    first = node
    while True:
        edge = last[node]
        assert edge is not None
        found.append(edge)
        node = edge.earlier
        if node == first:
            return found
