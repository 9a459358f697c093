"""Track: stay near a target, as long as a sensor sees it."""

from __future__ import annotations

import math

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Finding, Model, statuses
from swarmdsl.execution.space.functions.choice import Choice
from swarmdsl.execution.space.stage import Stage


class Track(Model):
    """Follow a target at a distance; aborted when it has been out of sight for a time.

    Done when its time is over. It begins where the target was told to be, if somebody did, else
    with the target that the robot saw last.
    """

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._x, self._y, self._height, self._speed, self._distance = np.zeros((5, stage.rows))
        self._lost, self._unseen, self._left = np.zeros((3, stage.rows))
        self._target = np.full(stage.rows, -1)
        self._choice = Choice(stage)

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Note which target, and where it should be."""
        stage, to = self.stage, arguments["to"]
        self._choice.note(who, arguments["target"])
        self._target[who] = -1
        seen = stage.eyes.latest[who] >= 0
        self._x[who] = np.where(seen, stage.eyes.place_x[who], stage.x[who])
        self._y[who] = np.where(seen, stage.eyes.place_y[who], stage.y[who])
        if to is not None:
            self._x[who], self._y[who] = to[0], to[1]
        self._height[who] = self.height(who, arguments)
        self._speed[who] = self.speed(who, arguments)
        self._distance[who] = arguments["distance"]
        self._lost[who], self._unseen[who] = arguments["lost"], 0.0
        self._left[who] = math.inf if arguments["time"] is None else arguments["time"]

    def step(self, who: Rows, dt: float) -> Small:
        """Go on to where the target was seen last, and stay at the distance."""
        stage = self.stage
        target = self._choice.seen(who)
        seen = target >= 0
        at = who[seen]
        self._x[at], self._y[at] = self._choice.places(at, target[seen])
        self._target[at] = target[seen]
        self._unseen[who] = np.where(seen, 0.0, self._unseen[who] + dt)
        dx, dy = self._x[who] - stage.x[who], self._y[who] - stage.y[who]
        way = np.sqrt(dx * dx + dy * dy)
        share = np.maximum(0.0, 1.0 - self._distance[who] / np.where(way > 0, way, 1.0))
        x, y = stage.x[who] + dx * share, stage.y[who] + dy * share
        stage.steer(who, x, y, self._height[who], self._speed[who], dt)
        self._left[who] -= dt
        over = self._left[who] < dt / 2
        return statuses(over, ~over & (self._unseen[who] >= self._lost[who]))

    def result(self, row: int) -> Finding:
        """Return where the target is, and which it is."""
        place = float(self._x[row]), float(self._y[row]), 0.0
        targets, target = self.stage.targets, int(self._target[row])
        return Finding(place, id=targets.names[target % targets.count] if target >= 0 else "")
