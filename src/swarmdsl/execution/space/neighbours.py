"""Pairs of robots within a distance, found by a grid: the time grows with their number."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Floats, Rows, Whole

_AROUND = ((0, 1), (1, -1), (1, 0), (1, 1))
"""Half of the cells around one; the others meet the same pairs from the other side."""


def pairs(x: Floats, y: Floats, run: Whole, rows: Rows, radius: float) -> tuple[Rows, Rows]:
    """Return all pairs of rows within a distance of each other, both ways, in order.

    `rows` are those that count, `run` the run of each row: robots of two runs never meet.
    """
    px, py = x[rows], y[rows]
    column = np.floor(px / radius).astype(np.int64)
    line = np.floor(py / radius).astype(np.int64)
    column -= column.min(initial=0)
    line -= line.min(initial=0)
    height = line.max(initial=0) + 3
    width = column.max(initial=0) + 3
    cells = (run[rows] * width + column + 1) * height + line + 1
    order = np.argsort(cells, kind="stable")
    cells, px, py, rows = cells[order], px[order], py[order], rows[order]
    first, second = _within(cells)
    firsts, seconds = [first], [second]
    for across, along in _AROUND:
        first, second = _between(cells, across * height + along)
        firsts.append(first)
        seconds.append(second)
    first, second = np.concatenate(firsts), np.concatenate(seconds)
    dx, dy = px[second] - px[first], py[second] - py[first]
    near = dx * dx + dy * dy <= radius * radius
    first, second = rows[first[near]], rows[second[near]]
    # One number per pair is sorted much faster than two.
    total = len(run)
    numbers = np.concatenate((first * total + second, second * total + first))
    numbers.sort()
    first = numbers // total
    return first, numbers - first * total


def _within(cells: Whole) -> tuple[Rows, Rows]:
    """Return the pairs of places in a sorted list that have the same cell, each once."""
    ends = np.searchsorted(cells, cells, side="right")
    places = np.arange(len(cells))
    return _spread(places, places + 1, ends)


def _between(cells: Whole, offset: int) -> tuple[Rows, Rows]:
    """Return the pairs of places whose cells differ by an offset."""
    wanted = cells + offset
    starts = np.searchsorted(cells, wanted, side="left")
    ends = np.searchsorted(cells, wanted, side="right")
    return _spread(np.arange(len(cells)), starts, ends)


def _spread(places: Rows, starts: Rows, ends: Rows) -> tuple[Rows, Rows]:
    """Return each place with all numbers from its start to before its end."""
    counts = np.maximum(ends - starts, 0)
    first = np.repeat(places, counts)
    before = np.repeat(np.cumsum(counts) - counts, counts)
    second = np.arange(len(first)) - before + np.repeat(starts, counts)
    return first, second
