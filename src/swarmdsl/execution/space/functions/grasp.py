"""Grasp: take the nearest target in reach."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Finding, Model, statuses
from swarmdsl.execution.space.functions.choice import Choice
from swarmdsl.execution.space.stage import Stage


class Grasp(Model):
    """Take a target, which takes a time; aborted if none is in reach, or another robot has it.

    A robot that carries something already is aborted too.
    """

    stops_on_contact = False

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._left, self._reach = np.zeros((2, stage.rows))
        self._choice = Choice(stage)
        self._taken: dict[int, str] = {}

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Note what to take, and how far the robot reaches."""
        self._choice.note(who, arguments["target"])
        self._left[who], self._reach[who] = arguments["time"], arguments["reach"]

    def step(self, who: Rows, dt: float) -> Small:
        """Wait for the hand; then the target belongs to the robot with the least number."""
        stage = self.stage
        stage.halt(who)
        self._left[who] -= dt
        over = self._left[who] < dt / 2
        done, failed = np.zeros((2, len(who)), dtype=np.bool_)
        full = np.isin(who, stage.targets.carrier)
        for number, row in enumerate(who.tolist()):
            target = None if full[number] else self._choice.nearest(row, float(self._reach[row]))
            if target is None:
                failed[number] = True
            elif over[number]:
                stage.targets.carrier[target] = row
                self._taken[row] = stage.targets.names[target % stage.targets.count]
                done[number] = True
        return statuses(done, failed)

    def result(self, row: int) -> Finding:
        """Return which target the robot has, and where."""
        stage = self.stage
        place = float(stage.x[row]), float(stage.y[row]), float(stage.z[row])
        return Finding(place, id=self._taken[row])
