"""Confidence intervals of probabilities and means.

Probabilities have the interval of C. Clopper and E. Pearson, 1934, which holds at least its
level for each number of runs. Quantiles come from the regularized incomplete beta function, by
its continued fraction (Numerical Recipes, 6.4) and bisection.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

_TINY = 1e-300
_EXACT = 1e-16
_MOST_TERMS = 10_000
_HALVINGS = 200


class Interval(NamedTuple):
    """Lower and upper bound."""

    lower: float
    upper: float


def clopper_pearson(successes: int, runs: int, level: float) -> Interval:
    """Return the interval of a probability, from the number of successes in independent runs."""
    outside = (1 - level) / 2
    lower, upper = 0.0, 1.0
    if successes > 0:
        lower = _beta_quantile(outside, successes, runs - successes + 1)
    if successes < runs:
        upper = _beta_quantile(1 - outside, successes + 1, runs - successes)
    return Interval(lower, upper)


@lru_cache(1024)
def student_quantile(probability: float, freedom: float) -> float:
    """Return the quantile of Student's distribution; the probability is above 0.5."""
    tail = 2 * (1 - probability)
    share = _beta_quantile(tail, freedom / 2, 0.5)
    return math.sqrt(freedom * (1 - share) / share)


def mean_interval(mean: float, deviation: float, count: int, level: float) -> Interval | None:
    """Return the interval of a mean by Student's distribution; None for fewer than two values."""
    if count < 2:
        return None
    half = student_quantile((1 + level) / 2, count - 1) * deviation / math.sqrt(count)
    return Interval(mean - half, mean + half)


def _beta_quantile(probability: float, a: float, b: float) -> float:
    return _root(lambda x: _beta_share(x, a, b) - probability)


def _root(rising: Callable[[float], float]) -> float:
    """Return the root of a rising function between 0 and 1."""
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        if middle in (low, high):
            break
        if rising(middle) < 0:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def _beta_share(x: float, a: float, b: float) -> float:
    """Return the regularized incomplete beta function."""
    if x <= 0 or x >= 1:
        return min(max(x, 0.0), 1.0)
    if x > (a + 1) / (a + b + 2):
        return 1 - _beta_share(1 - x, b, a)
    logarithm = math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b)
    logarithm += a * math.log(x) + b * math.log1p(-x)
    return math.exp(logarithm) * _fraction(x, a, b) / a


def _fraction(x: float, a: float, b: float) -> float:
    """Return the continued fraction of the incomplete beta function, by Lentz' method."""
    c, d = 1.0, 1 / _not_zero(1 - (a + b) * x / (a + 1))
    value = d
    for m in range(1, _MOST_TERMS):
        even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
        odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
        for term in (even, odd):
            d = 1 / _not_zero(1 + term * d)
            c = _not_zero(1 + term / c)
            value *= c * d
        if abs(c * d - 1) < _EXACT:
            break
    return value


def _not_zero(value: float) -> float:
    return value if abs(value) > _TINY else _TINY
