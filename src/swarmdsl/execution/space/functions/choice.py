"""Targets that functions are about: one by its name, those of a kind, or any."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Rows, Whole
from swarmdsl.execution.space.stage import Stage

ANY = -1
"""Any target of any kind."""
NONE = -2
"""A target or a kind that the environment does not have."""


class Choice:
    """For each robot, the kind of target or the one target that its function is about."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._kind: Whole = np.full(stage.rows, ANY)
        self._one: Whole = np.full(stage.rows, ANY)

    def note(self, who: Rows, word: str | None) -> None:
        """Choose a kind or a target by its name; without a word, any target."""
        targets = self._stage.targets
        self._kind[who] = self._one[who] = ANY
        if word and word in targets.names:
            self._one[who] = targets.names.index(word)
        elif word:
            self._kind[who] = targets.kinds.index(word) if word in targets.kinds else NONE

    def fits(self, who: Rows, targets: Whole) -> Flags:
        """Return which targets of all runs are chosen, one for each robot; -1 is no target."""
        of = self._stage.targets
        if not of.count:
            return np.zeros(len(who), dtype=np.bool_)
        there = np.maximum(targets, 0)
        kind, one = self._kind[who], self._one[who]
        fits: Flags = (targets >= 0) & ((kind == ANY) | (of.kind[there] == kind))
        fits &= (one == ANY) | (there % of.count == one)
        return fits

    def sees(self, who: Rows) -> Flags:
        """Return which robots have seen a target of theirs with their last look."""
        return self.fits(who, self._stage.eyes.latest[who])

    def name_seen(self, row: int) -> str:
        """Return the name of the target that a robot saw last, or "" without any."""
        target = int(self._stage.eyes.latest[row])
        of = self._stage.targets
        return of.names[target % of.count] if target >= 0 else ""

    def nearest(self, row: int, reach: float) -> int | None:
        """Return the nearest target in reach that is free, of all runs; of equal ones the first."""
        stage, of = self._stage, self._stage.targets
        first = int(stage.run[row]) * of.count
        those = np.arange(first, first + of.count)
        dx, dy = of.x[those] - stage.x[row], of.y[those] - stage.y[row]
        dz = of.z[those] - stage.z[row]
        way = np.sqrt(dx * dx + dy * dy + dz * dz)
        free = self.fits(np.full(of.count, row), those) & (way <= reach)
        free &= ~of.taken[those] & (of.carrier[those] < 0)
        if not free.any():
            return None
        return int(those[np.argmin(np.where(free, way, np.inf))])
