"""Drive: go straight on or backwards, turn on the spot, or both along an arc."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Floats, Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Model, statuses
from swarmdsl.execution.space.stage import Stage
from swarmdsl.execution.space.turning import direction

_LEAST = 0.001
"""Speed in m/s of a robot that cannot move, so that its time is finite."""


class Drive(Model):
    """Go a distance along a part of a circle, by the angle of a turn; straight on without one.

    The robot begins in the direction in which it looks, and in the end looks along the arc, also
    after it has gone backwards.
    """

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._left, self._speed, self._rate = np.zeros((3, stage.rows))
        self._to_x, self._to_y, self._to_z = np.zeros((3, stage.rows))
        """Place on the arc where each robot should be after this step."""
        self._x, self._y = np.zeros((2, stage.rows))
        """Direction in which each robot looks, even while it goes backwards."""

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Begin in the direction of now, with the pace of what takes longer: way or turn."""
        stage = self.stage
        distance, turn = arguments["distance"], arguments["turn"]
        speed = np.minimum(self.speed(who, arguments), stage.speed[who])
        if distance:
            time = np.maximum(
                abs(distance) / np.maximum(speed, _LEAST), abs(turn) / arguments["rate"]
            )
        else:
            time = np.full(len(who), abs(turn) / arguments["rate"])
        self._left[who] = time
        lasting = np.maximum(time, stage.dt)
        self._speed[who], self._rate[who] = distance / lasting, turn / lasting
        self._to_x[who], self._to_y[who] = stage.x[who], stage.y[who]
        self._to_z[who] = self.height(who, arguments)
        self._x[who], self._y[who] = stage.heading_x[who], stage.heading_y[who]

    def step(self, who: Rows, dt: float) -> Small:
        """Go on along the arc: in each step on a chord, which has the direction of its middle."""
        stage = self.stage
        time = np.minimum(np.maximum(self._left[who], 0.0), dt)
        over = self._left[who] <= 0
        self._left[who] -= time
        half = direction(self._rate[who] * time / 2)
        x, y = _turned(self._x[who], self._y[who], half)
        self._to_x[who] += x * self._speed[who] * time
        self._to_y[who] += y * self._speed[who] * time
        self._x[who], self._y[who] = _turned(x, y, half)
        places = self._to_x[who], self._to_y[who], self._to_z[who]
        there = stage.steer(who, *places, stage.speed[who], dt)
        stage.heading_x[who], stage.heading_y[who] = self._x[who], self._y[who]
        return statuses(over & there)


def _turned(x: Floats, y: Floats, by: tuple[Floats, Floats]) -> tuple[Floats, Floats]:
    """Return directions that are turned to the left by angles, given as cosines and sines."""
    cosine, sine = by
    return x * cosine - y * sine, y * cosine + x * sine
