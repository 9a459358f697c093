"""Summary of a sample of numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from swarmdsl.execution.estimation.intervals import Interval, mean_interval

QUANTILES = (0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0)


@dataclass(frozen=True)
class Sample:
    """Mean with its interval, None for fewer than two values, and QUANTILES."""

    count: int
    mean: float
    deviation: float
    interval: Interval | None
    quantiles: tuple[float, ...]


def summarize(values: Sequence[float], level: float) -> Sample | None:
    """Return the summary of a sample; None if it is empty."""
    if not values:
        return None
    count = len(values)
    mean = math.fsum(values) / count
    squares = math.fsum((value - mean) ** 2 for value in values)
    deviation = math.sqrt(squares / (count - 1)) if count > 1 else 0.0
    ordered = sorted(values)
    quantiles = tuple(_quantile(ordered, each) for each in QUANTILES)
    return Sample(count, mean, deviation, mean_interval(mean, deviation, count, level), quantiles)


def _quantile(ordered: Sequence[float], share: float) -> float:
    """Return a quantile, between two values by linear interpolation (type 7 of R)."""
    place = share * (len(ordered) - 1)
    below = math.floor(place)
    above = min(below + 1, len(ordered) - 1)
    return ordered[below] + (place - below) * (ordered[above] - ordered[below])
