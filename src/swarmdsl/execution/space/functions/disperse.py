"""Dispersion: robots move away from those that are nearer than a distance."""

from __future__ import annotations

import math

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats, Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Model, statuses
from swarmdsl.execution.space.functions.vectors import (
    at_most_one,
    counts,
    lengths,
    near_pairs,
    places,
    sums,
    unit,
)
from swarmdsl.execution.space.stage import Stage

EDGE = 1.25
"""Push at no distance; a quarter of it is left at the distance to have, which is thus reached."""


def away(position: Floats, first: Rows, second: Rows, distance: Floats) -> tuple[Floats, Flags]:
    """Return the direction of each robot, at most of length 1, and whether it is clear.

    A robot is pushed from each neighbour nearer than its distance, the more the nearer that is; it
    is clear if there is none. Robots at one place part along x, in the order of their numbers.
    """
    robots = len(position)
    offset = position[first] - position[second]
    same = lengths(offset) == 0
    offset[same, 0] = np.sign(first[same] - second[same])
    length = np.where(same, 0.0, lengths(offset))
    close = length < distance[first]
    weight = np.where(close, EDGE - length / distance[first], 0.0)
    push = unit(offset) * weight[:, None]
    return at_most_one(sums(first, push, robots)), counts(first[close], robots) == 0


class Disperse(Model):
    """Move away from other robots; done when all robots of a run that do so are clear.

    One that stopped earlier could be in the way of another one. It is aborted when its time is
    over.
    """

    stops_on_contact = False

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._distance, self._height, self._speed, self._left = np.zeros((4, stage.rows))

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Note the distance to have."""
        self._distance[who] = arguments["distance"]
        self._height[who] = self.height(who, arguments)
        self._speed[who] = np.minimum(self.speed(who, arguments), self.stage.speed[who])
        self._left[who] = math.inf if arguments["time"] is None else arguments["time"]

    def step(self, who: Rows, dt: float) -> Small:
        """Move away from all robots that are too near."""
        stage, everybody = self.stage, np.flatnonzero(self.stage.alive)
        number = np.searchsorted(everybody, who)
        distance = np.zeros(len(everybody))
        distance[number] = self._distance[who]
        first, second = near_pairs(stage, everybody, distance)
        push, clear = away(places(stage, everybody)[:, :2], first, second, distance)
        wanted = push[number] * self._speed[who, None]
        stage.wanted_x[who], stage.wanted_y[who] = wanted[:, 0], wanted[:, 1]
        stage.keep_height(who, self._height[who], dt)
        crowded = np.zeros(len(stage.seeds), dtype=np.bool_)
        crowded[stage.run[who[~clear[number]]]] = True
        done = ~crowded[stage.run[who]]
        self._left[who] -= dt
        over = self._left[who] < dt / 2
        return statuses(done, over & ~done)
