"""Place: put down what the robot carries."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Model, statuses
from swarmdsl.execution.space.stage import Stage


class PutDown(Model):
    """Leave on the ground what a robot carries, which takes a time; aborted if it has nothing."""

    stops_on_contact = False

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._left = np.zeros(stage.rows)

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Note how long it takes."""
        self._left[who] = arguments["time"]

    def step(self, who: Rows, dt: float) -> Small:
        """Wait for the hand, and let go."""
        stage = self.stage
        stage.halt(who)
        has = np.isin(who, stage.targets.carrier)
        self._left[who] -= dt
        done = has & (self._left[who] < dt / 2)
        for row in who[done].tolist():
            stage.targets.release(row)
        return statuses(done, ~has)
