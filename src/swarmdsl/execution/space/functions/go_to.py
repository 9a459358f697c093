"""Go to a place, around what is in the way."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Model, Place, statuses

if TYPE_CHECKING:
    from swarmdsl.execution.space.stage import Stage


class GoTo(Model):
    """Go to a place by the shortest way there is, and be there within the tolerance.

    Without any way, it goes straight on, until something stops it.
    """

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        rows = stage.rows
        self._x, self._y, self._z = np.zeros(rows), np.zeros(rows), np.zeros(rows)
        self._speed, self._tolerance = np.zeros(rows), np.zeros(rows)
        self._way: dict[int, list[Place]] = {}
        """Places that come after the one that each robot goes to now, if there are any."""
        self._turns = np.zeros(rows, dtype=np.bool_)

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Find the way; a place on the ground is gone to at the height of now."""
        to, height = arguments["to"], arguments["height"]
        if height is None and to is not None and to[2] > 0:
            height = to[2]
        self._speed[who] = self.speed(who, arguments)
        stage = self.stage
        for row in who.tolist():
            here = float(stage.x[row]), float(stage.y[row]), float(stage.z[row])
            x, y = here[:2] if to is None else to[:2]
            x, y, self._tolerance[row] = self._inside(row, x, y, arguments["tolerance"])
            z = here[2] if height is None or not stage.flies[row] else height
            self._way[row] = stage.router.plan(here, (x, y, z), float(stage.radius[row]))
            self._go_on(row)

    def step(self, who: Rows, dt: float) -> Small:
        """Go on; done with the step that arrives, or within the tolerance."""
        stage = self.stage
        x, y, z = self._x[who], self._y[who], self._z[who]
        dx, dy, dz = x - stage.x[who], y - stage.y[who], z - stage.z[who]
        dz = np.where(stage.flies[who], dz, 0.0)
        near = np.sqrt(dx * dx + dy * dy + dz * dz) <= self._tolerance[who]
        arrives = stage.steer(who, x, y, z, self._speed[who], dt)
        turns = self._turns[who]
        for row in who[arrives & turns].tolist():
            self._go_on(row)
        return statuses(near & ~turns)

    def stop(self, who: Rows) -> None:
        """Forget the ways."""
        for row in who.tolist():
            self._way.pop(row, None)

    def _inside(self, row: int, x: float, y: float, tolerance: float) -> Place:
        """Return a place where the body has room, and the tolerance that is left.

        It is the nearest one to a place at the edge of the environment, if that is near enough.
        """
        if self.stage.bounds is None:
            return x, y, tolerance
        low_x, low_y, high_x, high_y = self.stage.bounds
        radius = float(self.stage.radius[row])
        inner_x = min(max(x, low_x + radius), high_x - radius)
        inner_y = min(max(y, low_y + radius), high_y - radius)
        dx, dy = inner_x - x, inner_y - y
        aside = math.sqrt(dx * dx + dy * dy)
        return (inner_x, inner_y, tolerance - aside) if aside <= tolerance else (x, y, tolerance)

    def _go_on(self, row: int) -> None:
        """Go to the next place of the way."""
        self._x[row], self._y[row], self._z[row] = self._way[row].pop(0)
        self._turns[row] = bool(self._way[row])
