"""Take off: climb to a height, above the place of now."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Model, statuses
from swarmdsl.execution.space.stage import Stage

HEIGHT = 2.0
"""Height in metres where nothing is said."""
TOLERANCE = 0.05
"""Height in metres up to which a robot is where it should be."""


class TakeOff(Model):
    """Climb; aborted for a robot that cannot fly, and under a ceiling that is too low."""

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._x, self._y, self._z = np.zeros((3, stage.rows))

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Note the height, and the place to stay above."""
        self._x[who], self._y[who] = self.stage.x[who], self.stage.y[who]
        self._z[who] = HEIGHT if arguments["height"] is None else arguments["height"]

    def step(self, who: Rows, dt: float) -> Small:
        """Climb on; done within the tolerance."""
        stage, z = self.stage, self._z[who]
        stage.steer(who, self._x[who], self._y[who], z, stage.speed[who], dt)
        there = np.abs(stage.z[who] - z) <= TOLERANCE
        return statuses(there, ~stage.flies[who] | (z > stage.ceiling))
