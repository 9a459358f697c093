"""Hover: stay where the robot is, against the wind, or wait on the ground."""

from __future__ import annotations

import math

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Model, statuses
from swarmdsl.execution.space.stage import Stage


class Hover(Model):
    """Stay at one place, for a time or until it is told to stop."""

    stops_on_contact = False

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._x, self._y, self._z, self._left = np.zeros((4, stage.rows))

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Note the place, and how long to stay."""
        stage = self.stage
        self._x[who], self._y[who], self._z[who] = stage.x[who], stage.y[who], stage.z[who]
        self._left[who] = math.inf if arguments["time"] is None else arguments["time"]

    def step(self, who: Rows, dt: float) -> Small:
        """Stay on; done when its time is over."""
        stage = self.stage
        stage.steer(who, self._x[who], self._y[who], self._z[who], stage.speed[who], dt)
        self._left[who] -= dt
        over = self._left[who] < dt / 2
        return statuses(over)
