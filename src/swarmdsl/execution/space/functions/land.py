"""Land: go down to the ground, below the place of now."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Model, statuses
from swarmdsl.execution.space.stage import Stage


class Land(Model):
    """Go down as fast as the body climbs; a robot on the ground is done."""

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._x, self._y = np.zeros((2, stage.rows))

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Note the place to come down at."""
        self._x[who], self._y[who] = self.stage.x[who], self.stage.y[who]

    def step(self, who: Rows, dt: float) -> Small:
        """Go down on; done on the ground."""
        stage = self.stage
        ground = np.zeros(len(who))
        stage.steer(who, self._x[who], self._y[who], ground, stage.speed[who], dt)
        return statuses(stage.z[who] <= 0)
