"""Go to a place in a straight line."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Model, statuses

if TYPE_CHECKING:
    from swarmdsl.execution.space.stage import Stage


class GoTo(Model):
    """Go to a place, and be there within the tolerance."""

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        rows = stage.rows
        self._x, self._y, self._z = np.zeros(rows), np.zeros(rows), np.zeros(rows)
        self._speed, self._tolerance = np.zeros(rows), np.zeros(rows)

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Note where to go; a place on the ground is gone to at the height of now."""
        to = arguments["to"]
        stage = self.stage
        self._x[who] = stage.x[who] if to is None else to[0]
        self._y[who] = stage.y[who] if to is None else to[1]
        height = arguments["height"]
        if height is None and to is not None and to[2] > 0:
            height = to[2]
        self._z[who] = stage.z[who] if height is None else height
        self._speed[who] = self.speed(who, arguments)
        self._tolerance[who] = arguments["tolerance"]

    def step(self, who: Rows, dt: float) -> Small:
        """Go on; done with the step that arrives, or within the tolerance."""
        stage = self.stage
        x, y, z = self._x[who], self._y[who], self._z[who]
        dx, dy, dz = x - stage.x[who], y - stage.y[who], z - stage.z[who]
        dz = np.where(stage.flies[who], dz, 0.0)
        near = np.sqrt(dx * dx + dy * dy + dz * dz) <= self._tolerance[who]
        stage.steer(who, x, y, z, self._speed[who], dt)
        return statuses(near)
