"""Aggregation as of cockroaches: who meets others that rest is likelier to stop, and to stay.

- R. Jeanson, C. Rivault, J.-L. Deneubourg, S. Blanco, R. Fournier, C. Jost, G. Theraulaz:
  Self-organized aggregation in cockroaches. Animal Behaviour 69, 169-180 (2005).
- S. Garnier et al.: The embodiment of cockroach aggregation behavior in a group of micro-robots.
  Artificial Life 14, 387-408 (2008): the same rules in robots.

A robot that walks stops, and one that rests walks on, at a rate that depends on the number of
resting robots within reach.

The form of the rule is that of the paper. The rates have not been checked against its tables.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats, Rows, Small, Whole
from swarmdsl.execution.space.functions.base import Arguments, Model, statuses
from swarmdsl.execution.space.functions.random_walk import RandomWalk
from swarmdsl.execution.space.functions.vectors import counts, near_pairs
from swarmdsl.execution.space.hashing import key
from swarmdsl.execution.space.stage import Stage

_CHANGE = key("aggregate", "change")

STOP = (0.03, 0.42, 0.50, 0.51)
"""Rates to stop, per second, with 0, 1, 2, and 3 or more resting neighbours."""

LEAVE = (1 / 49, 1 / 424, 1 / 700, 1 / 1306)
"""Rates to walk on, per second, with 0, 1, 2, and 3 or more resting neighbours."""


def resting(
    rests: Flags,
    near: Whole,
    drawn: Floats,
    dt: float,
    stop: Sequence[float] = STOP,
    leave: Sequence[float] = LEAVE,
) -> Flags:
    """Return which robots rest after a step.

    `near` has the numbers of resting neighbours and `drawn` a number from 0 up to 1 for each robot.
    The time until a change has an exponential distribution, whatever the step.
    """
    changes = np.where(rests, _chances(leave, dt, near), _chances(stop, dt, near))
    return rests ^ (drawn < changes)


def _chances(rates: Sequence[float], dt: float, near: Whole) -> Floats:
    table = np.array([-math.expm1(-rate * dt) for rate in rates])
    return table[np.minimum(near, len(rates) - 1)]


class Aggregate(Model):
    """Walk about, and rest beside others that rest; done when enough of them are together.

    Only robots that do the same count. Without a number of them, it is done when its time is over;
    with one, it is aborted then.
    """

    stops_on_contact = False

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._walk = RandomWalk(stage)
        self._reach, self._size, self._left = np.zeros((3, stage.rows))
        self.rests: Flags = np.zeros(stage.rows, dtype=np.bool_)
        self._count = np.zeros(stage.rows, dtype=np.int64)

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Begin with walking."""
        self._walk.start(who, {**arguments, "time": None, "target": None, "which": "any"})
        self._reach[who] = arguments["range"]
        self._size[who] = math.inf if arguments["size"] is None else arguments["size"]
        self._left[who] = math.inf if arguments["time"] is None else arguments["time"]
        self.rests[who] = False

    def step(self, who: Rows, dt: float) -> Small:
        """Let robots stop or walk on, as many as rest beside each of them say."""
        stage = self.stage
        first, second = near_pairs(stage, who, self._reach[who])
        near = counts(first[self.rests[who][second]], len(who))
        drawn = stage.chance(who, _CHANGE, self._count[who])
        self._count[who] += 1
        self.rests[who] = resting(self.rests[who], near, drawn, dt)
        self._walk.step(who[~self.rests[who]], dt)
        stage.halt(who[self.rests[who]])
        together = self.rests[who] & (near + 1 >= self._size[who])
        self._left[who] -= dt
        over = self._left[who] < dt / 2
        alone = np.isinf(self._size[who])
        return statuses(together | (over & alone), over & ~alone & ~together)

    def stop(self, who: Rows) -> None:
        """Rest no more."""
        self.rests[who] = False
