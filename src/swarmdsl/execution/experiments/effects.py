"""Main effects and interactions of factors in a full factorial design.

Each seed runs all points, so that it gives one value of each effect: the values of many seeds are
independent, and have an interval by Student's distribution, whatever the points of one seed have
in common. Shares of variance are the sums of squares of the classical analysis of variance of the
points' means (R. Fisher, 1925).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, product

from swarmdsl.execution.estimation.intervals import Interval
from swarmdsl.execution.estimation.sample import summarize
from swarmdsl.execution.experiments.comparing import together, trusted_interval
from swarmdsl.execution.experiments.designs.factors import Factor, Point, Value

Table = Mapping[Point, Mapping[int, float]]
"""Value of each point in each run, by seed."""


@dataclass(frozen=True)
class LevelMean:
    """Mean of a measure at some levels, and what they add to the mean of all points.

    Two levels of two factors add what neither adds by itself. Intervals of what is added hold
    together for all levels of an effect.
    """

    levels: tuple[Value, ...]
    mean: float
    interval: Interval | None
    added: float
    added_interval: Interval | None


@dataclass(frozen=True)
class Effect:
    """Effect of one factor, or interaction of two.

    `share` is that of the variance between the means of points, None if these are equal. `size` is
    the distance of the greatest from the least `added` by the deviation of one run around the mean
    of its point, None without deviation. `is_certain` says that some interval is not around 0.
    """

    factors: tuple[str, ...]
    levels: tuple[LevelMean, ...]
    share: float | None
    size: float | None
    is_certain: bool


@dataclass(frozen=True)
class Effects:
    """Effects from the seeds with which all points have a value; `left_out` are the others."""

    mean: float
    seeds: tuple[int, ...]
    left_out: int
    main: tuple[Effect, ...]
    interactions: tuple[Effect, ...]
    rest: float | None
    """Share of the variance that no main effect and no interaction of two factors has."""


def effects(factors: Sequence[Factor], table: Table, level: float) -> Effects | None:
    """Return the effects in a full factorial design; None if no seed has run all points."""
    every = {seed for values in table.values() for seed in values}
    common = sorted(seed for seed in every if all(seed in each for each in table.values()))
    varied = [number for number, factor in enumerate(factors) if len(factor.levels) > 1]
    if not common or not varied:
        return None
    analysis = _Analysis(factors, table, common, level)
    main = tuple(analysis.effect((each,)) for each in varied)
    pairs = tuple(analysis.effect(pair) for pair in combinations(varied, 2))
    shares = [each.share for each in (*main, *pairs) if each.share is not None]
    rest = max(1 - math.fsum(shares), 0.0) if shares else None
    return Effects(analysis.mean, tuple(common), len(every) - len(common), main, pairs, rest)


class _Analysis:
    def __init__(
        self, factors: Sequence[Factor], table: Table, seeds: Sequence[int], level: float
    ) -> None:
        self._factors = factors
        self._points = list(table)
        self._rows = [[table[point][seed] for seed in seeds] for point in self._points]
        self._level = level
        self._means = [math.fsum(row) / len(row) for row in self._rows]
        self.mean = math.fsum(self._means) / len(self._means)
        self._of_seeds = [_mean(column) for column in zip(*self._rows, strict=True)]
        between = math.fsum((each - self.mean) ** 2 for each in self._means)
        # What rounding alone can make is no difference.
        self._rounding = 1e-12 * max(abs(value) for row in self._rows for value in row)
        self._between = between if between > len(self._means) * self._rounding**2 else 0.0
        self._deviation = self._within()

    def _within(self) -> float:
        """Return the deviation of one run around the mean of its point."""
        squares = (
            (value - mean) ** 2
            for row, mean in zip(self._rows, self._means, strict=True)
            for value in row
        )
        freedom = sum(len(row) - 1 for row in self._rows)
        return math.sqrt(math.fsum(squares) / freedom) if freedom else 0.0

    def effect(self, numbers: tuple[int, ...]) -> Effect:
        """Return the effect of a factor, or the interaction of two, by their numbers."""
        # Two levels add the same with opposite signs, so that one interval is about both.
        different = math.prod(
            len(self._factors[each].levels) if len(self._factors[each].levels) > 2 else 1
            for each in numbers
        )
        level = together(self._level, different)
        found = tuple(self._level_means(numbers, level))
        added = [each.added for each in found]
        squares = math.fsum(each**2 for each in added) * len(self._points) / len(found)
        return Effect(
            tuple(self._factors[each].name for each in numbers),
            found,
            squares / self._between if self._between else None,
            (max(added) - min(added)) / self._deviation if self._deviation else None,
            any(
                each.added_interval is not None
                and not each.added_interval.lower <= 0 <= each.added_interval.upper
                for each in found
            ),
        )

    def _level_means(self, numbers: tuple[int, ...], level: float) -> Iterator[LevelMean]:
        for levels in product(*(self._factors[each].levels for each in numbers)):
            at = dict(zip(numbers, levels, strict=True))
            means = self._seed_means(at)
            added = [each if abs(each) > self._rounding else 0.0 for each in self._added(at)]
            sample, extra = summarize(means, self._level), summarize(added, level)
            assert sample is not None
            assert extra is not None
            yield LevelMean(
                levels, sample.mean, sample.interval, extra.mean, trusted_interval(extra, level)
            )

    def _added(self, at: Mapping[int, Value]) -> list[float]:
        """Return what levels of one or two factors add, for each seed."""
        columns = [self._seed_means(at)]
        if len(at) == 2:
            columns += [self._seed_means({number: value}) for number, value in at.items()]
            return [
                both - first - second + whole
                for both, first, second, whole in zip(*columns, self._of_seeds, strict=True)
            ]
        return [mean - whole for mean, whole in zip(*columns, self._of_seeds, strict=True)]

    def _seed_means(self, at: Mapping[int, Value]) -> list[float]:
        """Return the mean of all points with some levels, for each seed."""
        rows = [
            row
            for point, row in zip(self._points, self._rows, strict=True)
            if all(point[number] == value for number, value in at.items())
        ]
        return [_mean(column) for column in zip(*rows, strict=True)]


def _mean(values: Sequence[float]) -> float:
    return math.fsum(values) / len(values)
