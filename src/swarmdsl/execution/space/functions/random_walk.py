"""Go straight on, and in another direction after a distance or a contact."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Finding, Model, statuses
from swarmdsl.execution.space.functions.choice import Choice
from swarmdsl.execution.space.hashing import key
from swarmdsl.execution.space.turning import direction

if TYPE_CHECKING:
    from swarmdsl.execution.space.stage import Stage

_DIRECTION, _LENGTH = key("random_walk", "direction"), key("random_walk", "length")


class RandomWalk(Model):
    """Walk of straight legs, whose lengths are between half and one and a half of the mean.

    With a target, it is done when the robot sees one, and aborted when its time is over.

    It is a correlated random walk if turns are less than a full circle wide (P. M. Kareiva and
    N. Shigesada: Analyzing insect movement as a correlated random walk. Oecologia 56, 1983).
    """

    stops_on_contact = False

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        rows = stage.rows
        self._legs = np.zeros(rows, dtype=np.int64)
        self._goes = np.zeros(rows, dtype=np.bool_)
        self._left, self._leg, self._time = np.zeros(rows), np.zeros(rows), np.zeros(rows)
        self._x, self._y, self._speed = np.zeros(rows), np.zeros(rows), np.zeros(rows)
        self._height, self._turn = np.zeros(rows), np.zeros(rows)
        self._choice = Choice(stage)
        self._found = np.full(rows, -1)
        self._looks = np.zeros(rows, dtype=np.bool_)

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Choose the first direction with the first step."""
        self._left[who] = 0.0
        self._looks[who] = arguments["target"] is not None
        self._choice.note(who, arguments["target"], arguments["which"])
        looking = who[self._looks[who]]
        self.stage.eyes.latest[looking] = -1
        self.stage.eyes.visible[looking] = False
        self._leg[who] = arguments["leg"]
        self._turn[who] = arguments["turn"]
        self._x[who], self._y[who] = self.stage.heading_x[who], self.stage.heading_y[who]
        self._goes[who] = False
        self._time[who] = math.inf if arguments["time"] is None else arguments["time"]
        self._height[who] = self.height(who, arguments)
        self._speed[who] = np.minimum(self.speed(who, arguments), self.stage.speed[who])

    def step(self, who: Rows, dt: float) -> Small:
        """Go on, or turn, until its time is over or it sees a target."""
        stage = self.stage
        turns = (self._left[who] <= 0) | stage.touched[who]
        if turns.any():
            turning = who[turns]
            self._legs[turning] += 1
            count = self._legs[turning]
            # The first direction is any, and that after a contact.
            goes_on = self._goes[turning] & ~stage.touched[turning]
            width = np.where(goes_on, self._turn[turning], 2 * math.pi)
            cosine, sine = direction(width * (stage.chance(turning, _DIRECTION, count) - 0.5))
            x, y = self._x[turning], self._y[turning]
            self._x[turning], self._y[turning] = cosine * x - sine * y, sine * x + cosine * y
            self._goes[turning] = True
            self._left[turning] = self._leg[turning] * (0.5 + stage.chance(turning, _LENGTH, count))
        speed = self._speed[who]
        self._left[who] -= speed * dt
        self._time[who] -= dt
        stage.wanted_x[who] = self._x[who] * speed
        stage.wanted_y[who] = self._y[who] * speed
        stage.keep_height(who, self._height[who], dt)
        over, looks = self._time[who] < dt / 2, self._looks[who]
        if not looks.any():
            return statuses(over)
        target = np.where(looks, self._choice.seen(who), -1)
        seen = target >= 0
        self._found[who[seen]] = target[seen]
        self._choice.claim(who[seen], target[seen])
        return statuses(seen | (over & ~looks), over & looks & ~seen)

    def result(self, row: int) -> Finding:
        """Return the target that the robot has found, or where it is."""
        if not self._looks[row]:
            found = super().result(row)
            assert isinstance(found, Finding)
            return found
        return self._choice.finding(row, int(self._found[row]))
