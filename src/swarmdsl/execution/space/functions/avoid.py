"""Avoid: move away from what is too near."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Floats, Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Model, statuses
from swarmdsl.execution.space.functions.disperse import EDGE, away
from swarmdsl.execution.space.functions.vectors import at_most_one, near_pairs, places, unit
from swarmdsl.execution.space.stage import Stage

_STEP = 1e-4
"""Distance in metres over which the change of a clearance is taken."""


class Avoid(Model):
    """Move away from walls, obstacles, zones, the border and other robots.

    Done where nothing is nearer than the distance, aborted when its time is over.
    """

    stops_on_contact = False

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._distance, self._speed, self._height, self._left = np.zeros((4, stage.rows))

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Note the distance to keep."""
        self._distance[who] = arguments["distance"]
        self._speed[who] = np.minimum(self.speed(who, arguments), self.stage.speed[who])
        self._height[who] = self.height(who, arguments)
        self._left[who] = arguments["time"]

    def step(self, who: Rows, dt: float) -> Small:
        """Move away from what is nearest, and from all robots that are too near."""
        stage, everybody = self.stage, np.flatnonzero(self.stage.alive)
        number = np.searchsorted(everybody, who)
        keep = np.zeros(len(everybody))
        keep[number] = self._distance[who] + 2 * stage.radius[who]
        first, second = near_pairs(stage, everybody, keep)
        push, free = away(places(stage, everybody)[:, :2], first, second, keep)
        x, y, z = stage.x[who], stage.y[who], stage.z[who]
        gap = self._clearance(x, y, z) - stage.radius[who]
        near = gap < self._distance[who]
        lack = np.where(near, EDGE - gap / self._distance[who], 0.0)
        slope = np.stack(
            [
                self._clearance(x + _STEP, y, z) - self._clearance(x - _STEP, y, z),
                self._clearance(x, y + _STEP, z) - self._clearance(x, y - _STEP, z),
            ],
            axis=1,
        )
        direction = at_most_one(push[number] + unit(np.nan_to_num(slope)) * lack[:, None])
        wanted = direction * self._speed[who, None]
        stage.wanted_x[who], stage.wanted_y[who] = wanted[:, 0], wanted[:, 1]
        stage.keep_height(who, self._height[who], dt)
        clear = free[number] & ~near
        self._left[who] -= dt
        over = self._left[who] < dt / 2
        return statuses(clear, over & ~clear)

    def _clearance(self, x: Floats, y: Floats, z: Floats) -> Floats:
        """Return the distance of places from the nearest shape or border."""
        stage = self.stage
        found = stage.shapes.distances(x, y, z)
        if stage.bounds is not None:
            low_x, low_y, high_x, high_y = stage.bounds
            border = np.minimum(
                np.minimum(x - low_x, high_x - x), np.minimum(y - low_y, high_y - y)
            )
            found = np.minimum(found, border)
        return found
