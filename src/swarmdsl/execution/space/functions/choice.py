"""Targets that functions are about: one by its name, those of a kind, or any."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats, Rows, Whole
from swarmdsl.execution.space.functions.base import Finding
from swarmdsl.execution.space.stage import Stage
from swarmdsl.ir.function_models import ANY_TARGET

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
        self._only_new: Flags = np.zeros(stage.rows, dtype=np.bool_)
        self._told: set[tuple[int, int]] = set()
        """Robots with the targets that they have found before, of all runs."""

    def note(self, who: Rows, word: str | None, which: str = "any") -> None:
        """Choose a kind or a target by its name; without a word, any target.

        Which ones may be `new`: those that the robot has not found before with this function.
        """
        self._only_new[who] = which == "new"
        targets = self._stage.targets
        self._kind[who] = self._one[who] = ANY
        if word and word in targets.names:
            self._one[who] = targets.names.index(word)
        elif word and (word != ANY_TARGET or word in targets.kinds):
            self._kind[who] = targets.kinds.index(word) if word in targets.kinds else NONE

    def is_there(self, word: str) -> bool:
        """Return True for a kind or the name of a target of the environment, or any."""
        targets = self._stage.targets
        return (
            word in targets.kinds
            or word in targets.names
            or (word == ANY_TARGET and bool(targets.kinds))
        )

    def fits(self, who: Rows, targets: Whole) -> Flags:
        """Return which targets of all runs are chosen, one for each robot; -1 is no target."""
        of = self._stage.targets
        if not of.count:
            return np.zeros(len(who), dtype=np.bool_)
        there = np.maximum(targets, 0)
        kind, one = self._kind[who], self._one[who]
        fits: Flags = (targets >= 0) & ((kind == ANY) | (of.kind[there] == kind))
        fits &= (one == ANY) | (there % of.count == one)
        for number in np.flatnonzero(fits & self._only_new[who]).tolist():
            fits[number] = (int(who[number]), int(there[number])) not in self._told
        return fits

    def claim(self, who: Rows, targets: Whole) -> None:
        """Note that robots have found targets."""
        self._told.update(zip(who.tolist(), targets.tolist(), strict=True))

    def seen(self, who: Rows) -> Whole:
        """Return the target that each robot sees of those, of all runs; -1 without any."""
        stage, of = self._stage, self._stage.targets
        latest = stage.eyes.latest[who]
        found = np.where(self.fits(who, latest), latest, -1)
        others = np.flatnonzero((found < 0) & stage.eyes.visible[who].any(axis=1))
        for number in others.tolist():
            # What a robot sees last is one of several targets.
            row = int(who[number])
            those = np.flatnonzero(stage.eyes.visible[row]) + int(stage.run[row]) * of.count
            chosen = those[self.fits(np.full(len(those), row), those)]
            found[number] = chosen[0] if len(chosen) else -1
        return found

    def places(self, who: Rows, seen: Whole) -> tuple[Floats, Floats]:
        """Return where robots take targets for that they see."""
        eyes, of = self._stage.eyes, self._stage.targets
        last = eyes.latest[who] == seen
        x = np.where(last, eyes.place_x[who], of.x[seen])
        return x, np.where(last, eyes.place_y[who], of.y[seen])

    def finding(self, row: int, target: int) -> Finding:
        """Return a target that a robot sees, and where the robot takes it for."""
        (x,), (y,) = self.places(np.array([row]), np.array([target]))
        targets = self._stage.targets
        return Finding((float(x), float(y), 0.0), id=targets.names[target % targets.count])

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
