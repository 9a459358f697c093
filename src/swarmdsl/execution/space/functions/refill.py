"""Refill: fill the tank from which a robot sprays."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Model, statuses
from swarmdsl.execution.space.stage import Stage


class Refill(Model):
    """Stay for a time; then the tank is full."""

    stops_on_contact = False

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._left = np.zeros(stage.rows)

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Note how long it takes."""
        self._left[who] = arguments["time"]

    def step(self, who: Rows, dt: float) -> Small:
        """Wait until the tank is full."""
        self.stage.halt(who)
        self._left[who] -= dt
        done = self._left[who] < dt / 2
        self.stage.tank[who[done]] = 1.0
        return statuses(done)
