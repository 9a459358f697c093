"""Go straight on, and in another direction after a distance or a contact."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Model, statuses
from swarmdsl.execution.space.hashing import key
from swarmdsl.execution.space.turning import direction

if TYPE_CHECKING:
    from swarmdsl.execution.space.stage import Stage

_DIRECTION, _LENGTH = key("random_walk", "direction"), key("random_walk", "length")


class RandomWalk(Model):
    """Walk of straight legs, whose lengths are between half and one and a half of the mean."""

    stops_on_contact = False

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        rows = stage.rows
        self._legs = np.zeros(rows, dtype=np.int64)
        self._left, self._leg, self._time = np.zeros(rows), np.zeros(rows), np.zeros(rows)
        self._x, self._y, self._speed = np.zeros(rows), np.zeros(rows), np.zeros(rows)
        self._height = np.zeros(rows)

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Choose the first direction with the first step."""
        self._left[who] = 0.0
        self._leg[who] = arguments["leg"]
        self._time[who] = math.inf if arguments["time"] is None else arguments["time"]
        self._height[who] = self.height(who, arguments)
        self._speed[who] = np.minimum(self.speed(who, arguments), self.stage.speed[who])

    def step(self, who: Rows, dt: float) -> Small:
        """Go on, or turn; done when its time is over."""
        stage = self.stage
        turns = (self._left[who] <= 0) | stage.touched[who]
        if turns.any():
            turning = who[turns]
            self._legs[turning] += 1
            count = self._legs[turning]
            angle = 2 * math.pi * stage.chance(turning, _DIRECTION, count)
            self._x[turning], self._y[turning] = direction(angle)
            self._left[turning] = self._leg[turning] * (0.5 + stage.chance(turning, _LENGTH, count))
        speed = self._speed[who]
        self._left[who] -= speed * dt
        self._time[who] -= dt
        stage.wanted_x[who] = self._x[who] * speed
        stage.wanted_y[who] = self._y[who] * speed
        stage.wanted_z[who] = (self._height[who] - stage.z[who]) / dt
        return statuses(self._time[who] < dt / 2)
