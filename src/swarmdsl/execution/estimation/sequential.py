"""Sequential probability ratio test of A. Wald, 1945."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

Decision = Literal["high", "low"]
_LEAST = 1e-9
"""Distance of the tested probabilities from 0 and 1."""


@dataclass(frozen=True)
class Region:
    """Probabilities between which either decision is right, and the error of each outside."""

    lower: float
    upper: float
    error: float

    @staticmethod
    def around(probability: float, half: float, error: float) -> Region:
        """Return the region around a probability.

        It extends at most half the way to 0 and to 1: if it contained them, one run could decide
        against a probability of nearly 0 or 1. Around 0 and 1 themselves, it is on one side.
        """
        if 0 < probability < 1:
            half = min(half, probability / 2, (1 - probability) / 2)
        lower = max(probability - half, _LEAST)
        upper = min(probability + half, 1 - _LEAST)
        return Region(min(lower, 1 - 2 * _LEAST), max(upper, 2 * _LEAST), error)


class SequentialTest:
    """Test that a probability is high (at least `upper`) or low (at most `lower`).

    `decision` is None until there have been enough runs; `runs` is their number then.
    """

    def __init__(self, region: Region) -> None:
        self.decision: Decision | None = None
        self.runs = 0
        self._success = math.log(region.upper / region.lower)
        self._failure = math.log((1 - region.upper) / (1 - region.lower))
        self._bound = math.log((1 - region.error) / region.error)
        self._ratio = 0.0

    def add(self, *, success: bool) -> None:
        """Process a run; after a decision, it changes nothing."""
        if self.decision is not None:
            return
        self.runs += 1
        self._ratio += self._success if success else self._failure
        if self._ratio >= self._bound:
            self.decision = "high"
        elif self._ratio <= -self._bound:
            self.decision = "low"
