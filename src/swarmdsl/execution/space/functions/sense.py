"""Sense: stay and look, until a target is in sight or a time is over."""

from __future__ import annotations

import math

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Finding, Model, statuses
from swarmdsl.execution.space.functions.choice import Choice
from swarmdsl.execution.space.stage import Stage


class Sense(Model):
    """Look for a target; done when the robot sees one, aborted when its time is over."""

    stops_on_contact = False

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._left = np.zeros(stage.rows)
        self._found = np.full(stage.rows, -1)
        self._choice = Choice(stage)

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Note what to look for, and how long; what was seen before does not count."""
        self._choice.note(who, arguments["target"])
        self._left[who] = math.inf if arguments["time"] is None else arguments["time"]
        self.stage.eyes.latest[who] = -1
        self.stage.eyes.visible[who] = False

    def step(self, who: Rows, dt: float) -> Small:
        """Stay, and note whether a target is in sight."""
        self.stage.halt(who)
        target = self._choice.seen(who)
        seen = target >= 0
        self._found[who[seen]] = target[seen]
        self._left[who] -= dt
        over = self._left[who] < dt / 2
        return statuses(seen, over & ~seen)

    def result(self, row: int) -> Finding:
        """Return the target, and where the robot takes it for."""
        return self._choice.finding(row, int(self._found[row]))
