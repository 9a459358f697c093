"""Radio of robots: what distance and walls let through, and who comes in reach or out of it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from swarmdsl.execution.space.arrays import Whole

if TYPE_CHECKING:
    from swarmdsl.execution.space.stage import Stage


class Links:
    """Radio links between the robots of a stage."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        radios = [unit.radio for unit in stage.layout.units]
        self.is_needed = any(each is not None for each in radios)
        """True if somebody has a radio."""
        self.ranges = [math.inf if each is None else each.range for each in radios]
        self._losses = [0.0 if each is None else each.loss for each in radios]
        self._through = [1.0 if each is None else each.through for each in radios]
        limited = [each for each in self.ranges if math.isfinite(each)]
        self._longest = max(limited, default=0.0)
        self._blocked = not stage.shapes.is_empty and 0.0 in self._through
        self._range = np.tile(np.array(self.ranges), len(stage.seeds))
        self._no_way = np.tile(np.array(self._through) == 0.0, len(stage.seeds))
        self._crossed: dict[int, Whole] = {}

    def moved(self) -> None:
        """Forget what is only so while nobody moves."""
        self._crossed.clear()

    def reaches(self, run: int, one: int, other: int) -> bool:
        """Return True if what one robot of a run sends can arrive at another one."""
        longest = self.ranges[one]
        if self._square(run, one, other) > longest * longest:
            return False
        return self._through[one] > 0 or not self._crossings(run, one, other)

    def loss(self, run: int, one: int, other: int) -> float:
        """Return the probability that an event gets lost on its way between robots in reach.

        It grows with the square of the distance, up to that of the radio at its range.
        """
        longest = self.ranges[one]
        if not math.isfinite(longest) or longest <= 0:
            return 0.0
        arrives = 1 - self._losses[one] * (self._square(run, one, other) / (longest * longest))
        if self._through[one] < 1:
            for _ in range(self._crossings(run, one, other)):
                arrives *= self._through[one]
        return min(max(1 - arrives, 0.0), 1.0)

    def within(self) -> Whole:
        """Return who reaches whom among robots with a limited range, as sorted numbers."""
        stage = self._stage
        if not self._longest:
            return np.empty(0, dtype=np.int64)
        one, other = stage.pairs(self._longest)
        dx, dy = stage.x[one] - stage.x[other], stage.y[one] - stage.y[other]
        dz = stage.z[one] - stage.z[other]
        near = dx * dx + dy * dy + dz * dz <= self._range[one] * self._range[one]
        one, other = one[near], other[near]
        if self._blocked:
            start, end = (stage.x[one], stage.y[one]), (stage.x[other], stage.y[other])
            free = stage.shapes.crossings(start, end, (stage.z[one], stage.z[other])) == 0
            free |= ~self._no_way[one]
            one, other = one[free], other[free]
        links: Whole = one * stage.rows + other
        return links

    def _square(self, run: int, one: int, other: int) -> float:
        stage = self._stage
        first, second = run * stage.robots + one, run * stage.robots + other
        dx = float(stage.x[first]) - float(stage.x[second])
        dy = float(stage.y[first]) - float(stage.y[second])
        dz = float(stage.z[first]) - float(stage.z[second])
        return dx * dx + dy * dy + dz * dz

    def _crossings(self, run: int, one: int, other: int) -> int:
        """Return the number of walls and obstacles between two robots.

        Those between a robot and all others are computed when one is asked for.
        """
        stage = self._stage
        if stage.shapes.is_empty:
            return 0
        # Both ways the same, so that rounding is too.
        row, place = run * stage.robots + min(one, other), max(one, other)
        if row not in self._crossed:
            here = slice(run * stage.robots, (run + 1) * stage.robots)
            ends = (stage.x[here], stage.y[here])
            start = (np.full_like(ends[0], stage.x[row]), np.full_like(ends[1], stage.y[row]))
            heights = (np.full_like(ends[0], stage.z[row]), stage.z[here])
            self._crossed[row] = stage.shapes.crossings(start, ends, heights)
        return int(self._crossed[row][place])
