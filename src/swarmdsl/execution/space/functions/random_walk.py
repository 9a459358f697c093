"""Go straight on, and in another direction after a distance or a contact."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Finding, Model, statuses
from swarmdsl.execution.space.functions.choice import Choice
from swarmdsl.execution.space.functions.turns import Turns

if TYPE_CHECKING:
    from swarmdsl.execution.space.stage import Stage


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
        self._turns = Turns("random_walk", stage)
        self._goes = np.zeros(rows, dtype=np.bool_)
        self._left, self._leg, self._time = np.zeros(rows), np.zeros(rows), np.zeros(rows)
        self._x, self._y, self._speed = np.zeros(rows), np.zeros(rows), np.zeros(rows)
        self._height = np.zeros(rows)
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
        self._turns.begin(who, arguments["turn"])
        self._x[who], self._y[who] = self.stage.heading_x[who], self.stage.heading_y[who]
        self._goes[who] = False
        self._time[who] = math.inf if arguments["time"] is None else arguments["time"]
        self._height[who] = self.height(who, arguments)
        self._speed[who] = np.minimum(self.speed(who, arguments), self.stage.speed[who])

    def step(self, who: Rows, dt: float) -> Small:
        """Go on, or turn, until its time is over or it sees a target."""
        stage = self.stage
        here = stage.part_of(who)
        turning = who[(self._left[here] <= 0) | stage.touched[here]]
        if len(turning):
            # The first direction is any, and that after a contact.
            freely = ~self._goes[turning] | stage.touched[turning]
            cosine, sine, length = self._turns.take(turning, freely)
            x, y = self._x[turning], self._y[turning]
            self._x[turning], self._y[turning] = cosine * x - sine * y, sine * x + cosine * y
            self._goes[turning] = True
            self._left[turning] = self._leg[turning] * (0.5 + length)
        speed = self._speed[here]
        self._left[here] -= speed * dt
        time = self._time[here] - dt
        self._time[here] = time
        stage.wanted_x[here] = self._x[here] * speed
        stage.wanted_y[here] = self._y[here] * speed
        stage.keep_height(who, self._height[here], dt)
        over, looks = time < dt / 2, self._looks[here]
        if not np.count_nonzero(looks):
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
