"""Factors of a design, and their values from shares of the unit interval."""

from __future__ import annotations

import math
from dataclasses import dataclass

Value = bool | int | float | str


@dataclass(frozen=True)
class Factor:
    """Levels by name or number; or, without levels, all numbers from `low` to `high`."""

    name: str
    levels: tuple[Value, ...] = ()
    low: float = 0.0
    high: float = 1.0

    def at(self, share: float) -> Value:
        """Return the value at a share from 0 to 1: 0 is the first level, or the lowest number.

        Each level has an equal part of the unit interval.
        """
        if not self.levels:
            return min(max(self.low + share * (self.high - self.low), self.low), self.high)
        return self.levels[min(math.floor(share * len(self.levels)), len(self.levels) - 1)]

    @property
    def is_numeric(self) -> bool:
        """True if the values are numbers, so that a distance between two of them has a meaning."""
        return all(
            isinstance(each, (int, float)) and not isinstance(each, bool) for each in self.levels
        )


Point = tuple[Value, ...]
"""A value for each factor."""


def settle(factors: tuple[Factor, ...], shares: tuple[float, ...]) -> Point:
    """Return the point at some shares."""
    return tuple(factor.at(share) for factor, share in zip(factors, shares, strict=True))
