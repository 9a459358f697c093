"""Linear effects of factors in a design that is no full factorial one.

The values of each seed are fitted by least squares: one coefficient for a number, scaled from its
lowest to its highest value, and one for each level but the first of a factor by name. Each seed
gives one value of each coefficient, so that they have intervals by Student's distribution.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from swarmdsl.execution.estimation.intervals import Interval
from swarmdsl.execution.estimation.sample import summarize
from swarmdsl.execution.experiments.comparing import together, trusted_interval
from swarmdsl.execution.experiments.designs.factors import Factor, Point, Value

_SINGULAR = 1e-10
Matrix = list[list[float]]


@dataclass(frozen=True)
class Slope:
    """Change of a measure from one value of a factor to another, the other factors the same."""

    factor: str
    start: Value
    end: Value
    change: float
    interval: Interval | None

    @property
    def is_certain(self) -> bool:
        """True if the interval is not around 0."""
        return self.interval is not None and not self.interval.lower <= 0 <= self.interval.upper


@dataclass(frozen=True)
class Slopes:
    """Linear effects; `explained` is the share of the variance between points that they explain.

    Intervals hold together for all of them.
    """

    slopes: tuple[Slope, ...]
    explained: float | None
    seeds: tuple[int, ...]
    left_out: int


def slopes(
    factors: Sequence[Factor], table: Mapping[Point, Mapping[int, float]], level: float
) -> Slopes | None:
    """Return linear effects; None if no seed has run all points, or these are too few."""
    every = {seed for values in table.values() for seed in values}
    common = sorted(seed for seed in every if all(seed in each for each in table.values()))
    points = list(table)
    columns = list(_columns(factors, points))
    if not common or not columns or len(points) <= len(columns) + 1:
        return None
    rows = [[1.0, *(column.code(point) for column in columns)] for point in points]
    solved = _pseudo_inverse(rows)
    if solved is None:
        return None
    fitted = [_times(solved, [table[point][seed] for point in points]) for seed in common]
    each_level = together(level, len(columns))
    found = []
    for number, column in enumerate(columns, 1):
        sample = summarize([each[number] for each in fitted], each_level)
        assert sample is not None
        interval = trusted_interval(sample, each_level)
        found.append(
            Slope(factors[column.factor].name, column.start, column.end, sample.mean, interval)
        )
    means = [math.fsum(table[point][seed] for seed in common) / len(common) for point in points]
    explained = _explained(rows, _times(solved, means), means)
    return Slopes(tuple(found), explained, tuple(common), len(every) - len(common))


@dataclass(frozen=True)
class _Column:
    """Column of the linear model: 0 at `start`, 1 at `end`."""

    factor: int
    start: Value
    end: Value
    is_numeric: bool

    def code(self, point: Point) -> float:
        value = point[self.factor]
        if not self.is_numeric:
            return float(value == self.end)
        return (float(value) - float(self.start)) / (float(self.end) - float(self.start))


def _columns(factors: Sequence[Factor], points: Sequence[Point]) -> Iterator[_Column]:
    for number, factor in enumerate(factors):
        values = list(dict.fromkeys(point[number] for point in points))
        if len(values) < 2:
            continue
        if factor.is_numeric:
            numbers = [float(value) for value in values]
            yield _Column(number, min(numbers), max(numbers), True)
        else:
            first, *others = [each for each in factor.levels if each in values]
            yield from (_Column(number, first, other, False) for other in others)


def _pseudo_inverse(rows: Matrix) -> Matrix | None:
    """Return the matrix that makes coefficients of values; None if columns depend on others.

    It solves the normal equations by Gauss and Jordan.
    """
    width = len(rows[0])
    turned = [list(column) for column in zip(*rows, strict=True)]
    system = [
        [_dot(left, right) for right in turned] + turned[number]
        for number, left in enumerate(turned)
    ]
    for pivot in range(width):
        best = max(range(pivot, width), key=lambda row: abs(system[row][pivot]))
        system[pivot], system[best] = system[best], system[pivot]
        head = system[pivot][pivot]
        if abs(head) < _SINGULAR * len(rows):
            return None
        system[pivot] = [each / head for each in system[pivot]]
        for row in range(width):
            if row != pivot and (factor := system[row][pivot]):
                pairs = zip(system[row], system[pivot], strict=True)
                system[row] = [each - factor * other for each, other in pairs]
    return [row[width:] for row in system]


def _explained(rows: Matrix, fitted: Sequence[float], means: Sequence[float]) -> float | None:
    """Return the coefficient of determination of the means of points."""
    mean = math.fsum(means) / len(means)
    whole = math.fsum((each - mean) ** 2 for each in means)
    if whole <= len(means) * (1e-12 * mean) ** 2:
        return None
    left = math.fsum((each - _dot(row, fitted)) ** 2 for row, each in zip(rows, means, strict=True))
    return max(1 - left / whole, 0.0)


def _times(matrix: Matrix, values: Sequence[float]) -> list[float]:
    return [_dot(row, values) for row in matrix]


def _dot(left: Sequence[float], right: Sequence[float]) -> float:
    return math.fsum(a * b for a, b in zip(left, right, strict=True))
