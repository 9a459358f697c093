"""Model of bidding for a target: the rover gets it after a while, if it is not too far away."""

import numpy as np

from swarmdsl.execution.space.functions.base import Finding, Model, statuses
from swarmdsl.ir.function_models import Argument


class Bid(Model):
    """Wait for the answer; aborted for a target that is farther away than the rover drives."""

    arguments = (
        Argument("to", "place", None, "where the target is; without it, the place in the goal"),
        Argument("task_id", "text", None, "name of the target; without it, that in the goal"),
        Argument("time", "time", 3_000_000_000, "time until there is an answer"),
        Argument("farthest", "length", 100.0, "distance that the rover drives at most"),
    )
    stops_on_contact = False

    def __init__(self, stage):
        """Have room for all robots."""
        super().__init__(stage)
        self._left = np.zeros(stage.rows)
        self._fits = np.zeros(stage.rows, dtype=bool)
        self._offers = {}

    def start(self, who, arguments):
        """Note the target, and whether it is near enough."""
        place = arguments["to"] or (0.0, 0.0, 0.0)
        self._left[who] = arguments["time"]
        for row in who.tolist():
            way = np.hypot(place[0] - self.stage.x[row], place[1] - self.stage.y[row])
            self._fits[row] = way <= arguments["farthest"]
            self._offers[row] = Finding(place, id=arguments["task_id"] or "")

    def step(self, who, dt):
        """Wait."""
        self.stage.halt(who)
        self._left[who] -= dt
        over = self._left[who] < dt / 2
        return statuses(over & self._fits[who], over & ~self._fits[who])

    def result(self, row):
        """Return the target that the rover got."""
        return self._offers[row]
