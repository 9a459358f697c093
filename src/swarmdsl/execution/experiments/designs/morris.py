"""Screening by elementary effects (M. Morris, 1991; F. Campolongo and others, 2007).

A trajectory changes one factor after the other; each change gives an elementary effect, the change
of the value by the share of the factor's range. The mean of their sizes tells how much a factor
matters, their deviation how far this depends on the others or is not linear.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from swarmdsl.execution.estimation.sample import summarize
from swarmdsl.execution.simulate.scenario.random_source import RandomSource

_LEVELS = 4
_JUMP = _LEVELS // 2
Shares = tuple[float, ...]


@dataclass(frozen=True)
class Screened:
    """Mean size of the elementary effects of a factor, their mean and deviation."""

    size: float
    mean: float
    deviation: float


def trajectories(dimensions: int, count: int, seed: int) -> list[Shares]:
    """Return the points of `count` trajectories, each of `dimensions + 1`, one after the other."""
    found: list[Shares] = []
    for number in range(count):
        stream = RandomSource(seed).stream("morris", number)
        grid = [int(stream.random() * _LEVELS) for _ in range(dimensions)]
        found.append(_shares(grid))
        left = list(range(dimensions))
        while left:
            changed = left.pop(int(stream.random() * len(left)))
            # From the lower half of the grid up, from the upper half down.
            grid[changed] += _JUMP if grid[changed] < _JUMP else -_JUMP
            found.append(_shares(grid))
    return found


def _shares(grid: Sequence[int]) -> Shares:
    return tuple(each / (_LEVELS - 1) for each in grid)


def screen(points: Sequence[Shares], values: Sequence[float]) -> list[Screened]:
    """Return the effects of each factor from the values at the points of trajectories."""
    dimensions = len(points[0])
    effects: list[list[float]] = [[] for _ in range(dimensions)]
    for number in range(1, len(points)):
        if number % (dimensions + 1) == 0:
            continue  # another trajectory begins
        before, after = points[number - 1], points[number]
        (changed,) = (each for each in range(dimensions) if before[each] != after[each])
        change = values[number] - values[number - 1]
        effects[changed].append(change / (after[changed] - before[changed]))
    return [_screened(each) for each in effects]


def _screened(effects: Sequence[float]) -> Screened:
    sample = summarize(effects, 0.95)
    assert sample is not None  # each trajectory changes each factor
    size = math.fsum(map(abs, effects)) / len(effects)
    return Screened(size, sample.mean, sample.deviation)
