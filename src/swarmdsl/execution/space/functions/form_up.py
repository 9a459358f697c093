"""Formations: a place for each robot in a line, a wedge or a circle."""

from __future__ import annotations

import math

import numpy as np

from swarmdsl.execution.space.arrays import Floats, Rows, Small, Whole
from swarmdsl.execution.space.functions.base import Arguments, Model, statuses
from swarmdsl.execution.space.stage import Stage
from swarmdsl.execution.space.turning import direction, direction_of


def places(shape: str, count: int, spacing: float) -> Floats:
    """Return the places of a formation that heads along x, around their mean: an array (count, 2).

    A line is across the heading; in a wedge the first is in front and the others are behind it by
    turns on the left and on the right; in a circle neighbours are `spacing` apart.
    """
    number = np.arange(count)
    if shape == "line":
        made = np.stack([np.zeros(count), spacing * number], axis=1)
    elif shape == "wedge":
        row = (number + 1) // 2
        side = np.where(number % 2 == 1, 1.0, -1.0)
        made = spacing * np.stack([-row, side * row], axis=1) / math.sqrt(2)
    else:
        radius = spacing / (2 * math.sin(math.pi / count)) if count > 1 else 0.0
        made = radius * np.stack(direction(2 * np.pi * number / max(count, 1)), axis=1)
    return made - made.mean(axis=0) if count else made


class FormUp(Model):
    """Go to the place of the robot in a formation of its role; done there.

    The formation is around the mean of the robots of the role when the first of them begins; each
    has the place of its index. Robots that are lost leave gaps.
    """

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._x, self._y, self._height, self._speed, self._tolerance = np.zeros((5, stage.rows))
        self._group: Whole = stage.run * len(stage.roles) + stage.role
        self._busy = np.zeros(stage.rows, dtype=np.bool_)
        self._centres: dict[int, tuple[float, float]] = {}

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Find the place of each robot."""
        self._height[who] = self.height(who, arguments)
        self._speed[who] = self.speed(who, arguments)
        self._tolerance[who] = arguments["tolerance"]
        cosine, sine = direction_of(arguments["heading"])
        at = arguments["at"]
        for row in who.tolist():
            slots = places(arguments["shape"], int(self.stage.count[row]), arguments["spacing"])
            ahead, aside = slots[min(self.stage.index[row], len(slots) - 1)]
            centre = (at[0], at[1]) if at is not None else self._centre(row)
            self._x[row] = centre[0] + cosine * ahead - sine * aside
            self._y[row] = centre[1] + sine * ahead + cosine * aside
            self._busy[row] = True

    def step(self, who: Rows, dt: float) -> Small:
        """Go on to the place."""
        stage = self.stage
        x, y, z = self._x[who], self._y[who], self._height[who]
        dx, dy, dz = x - stage.x[who], y - stage.y[who], z - stage.z[who]
        dz = np.where(stage.flies[who], dz, 0.0)
        near = np.sqrt(dx * dx + dy * dy + dz * dz) <= self._tolerance[who]
        stage.steer(who, x, y, z, self._speed[who], dt)
        return statuses(near)

    def stop(self, who: Rows) -> None:
        """Forget the middle of a formation when nobody forms up any more."""
        self._busy[who] = False
        for group in np.unique(self._group[who]).tolist():
            if not self._busy[self._group == group].any():
                self._centres.pop(group, None)

    def _centre(self, row: int) -> tuple[float, float]:
        """Return the middle of the robots of a role, as of when the first of them began."""
        group = int(self._group[row])
        if group not in self._centres:
            stage = self.stage
            of = np.flatnonzero((self._group == group) & stage.alive).tolist()
            x = math.fsum(float(stage.x[each]) for each in of) / len(of)
            y = math.fsum(float(stage.y[each]) for each in of) / len(of)
            self._centres[group] = x, y
        return self._centres[group]
