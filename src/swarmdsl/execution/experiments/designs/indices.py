"""Sobol indices: the share of the variance that is due to a factor, alone and in all.

Points are those of A. Saltelli and others, "Variance based sensitivity analysis of model output",
2010: two independent samples A and B, and for each factor A with the column of B. Indices of first
order come from the estimator there (table 2, b), total ones from that of M. Jansen, 1999. Their
intervals are percentiles of a bootstrap over the rows of the samples.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from swarmdsl.execution.estimation.intervals import Interval
from swarmdsl.execution.experiments.designs.sobol import MOST_DIMENSIONS, sobol_sequence
from swarmdsl.execution.simulate.scenario.random_source import RandomSource

MOST_FACTORS = MOST_DIMENSIONS // 2
_RESAMPLES = 200
"""Samples of a bootstrap: with 1,000, intervals hold the truth as often and are as wide."""
Shares = tuple[float, ...]


@dataclass(frozen=True)
class Index:
    """Index of first order and total index of a factor, with their intervals."""

    first: float
    first_interval: Interval
    total: float
    total_interval: Interval


def saltelli_points(dimensions: int, rows: int, seed: int) -> list[Shares]:
    """Return `rows * (dimensions + 2)` points: of each row A, B, and A with one column of B."""
    found: list[Shares] = []
    for row in sobol_sequence(2 * dimensions, rows, seed):
        first, second = row[:dimensions], row[dimensions:]
        found += [first, second]
        found += [(*first[:each], second[each], *first[each + 1 :]) for each in range(dimensions)]
    return found


def sobol_indices(
    dimensions: int, values: Sequence[float], level: float, seed: int
) -> list[Index] | None:
    """Return the indices of each factor from the values at its points.

    None if the values do not vary, so that there is nothing to share.
    """
    width = dimensions + 2
    rows = [tuple(values[at : at + width]) for at in range(0, len(values), width)]
    estimates = _estimate(rows)
    if estimates is None:
        return None
    stream = RandomSource(seed).stream("bootstrap")
    drawn = []
    for _ in range(_RESAMPLES):
        sample = [rows[int(stream.random() * len(rows))] for _ in rows]
        again = _estimate(sample)
        if again is not None:
            drawn.append(again)
    found = []
    for factor in range(dimensions):
        first, total = estimates[factor]
        firsts = _percentiles([each[factor][0] for each in drawn], level)
        totals = _percentiles([each[factor][1] for each in drawn], level)
        found.append(Index(first, firsts, total, totals))
    return found


def _estimate(rows: Sequence[tuple[float, ...]]) -> list[tuple[float, float]] | None:
    """Return first and total index of each factor; None without variance."""
    count = len(rows)
    both = [value for row in rows for value in row[:2]]
    mean = math.fsum(both) / len(both)
    variance = math.fsum((value - mean) ** 2 for value in both) / len(both)
    if variance <= _rounding(mean):
        return None
    found = []
    for factor in range(len(rows[0]) - 2):
        # The estimator holds for any origin of the values; around their mean it is least noisy.
        alone = math.fsum((row[1] - mean) * (row[2 + factor] - row[0]) for row in rows)
        whole = math.fsum((row[0] - row[2 + factor]) ** 2 for row in rows)
        found.append((alone / count / variance, whole / (2 * count) / variance))
    return found


def _rounding(mean: float) -> float:
    """Return the variance that rounding alone can give values with this mean."""
    return (1e-12 * mean) ** 2


def _percentiles(values: Sequence[float], level: float) -> Interval:
    ordered = sorted(values)
    cut = math.floor((1 - level) / 2 * len(ordered))
    return Interval(ordered[cut], ordered[-1 - cut])
