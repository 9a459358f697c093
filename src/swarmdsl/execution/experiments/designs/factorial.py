"""Full factorial design: all combinations of levels."""

from __future__ import annotations

import math
from itertools import product

from swarmdsl.execution.experiments.designs.factors import Factor, Point


def full_factorial(factors: tuple[Factor, ...]) -> list[Point]:
    """Return all combinations; the last factor changes fastest. All factors have levels."""
    return list(product(*(factor.levels for factor in factors)))


def combinations(factors: tuple[Factor, ...]) -> int:
    """Return the number of points of the full factorial design."""
    return math.prod(len(factor.levels) for factor in factors)
