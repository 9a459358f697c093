"""Flocking: separation, alignment and cohesion, or the alignment of Vicsek alone.

- C. W. Reynolds: Flocks, herds, and schools: a distributed behavioral model. SIGGRAPH 1987.
- T. Vicsek, A. Czirok, E. Ben-Jacob, I. Cohen, O. Shochet: Novel type of phase transition in a
  system of self-driven particles. Physical Review Letters 75, 1226 (1995).
"""

from __future__ import annotations

import math

import numpy as np

from swarmdsl.execution.space.arrays import Floats, Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Model, statuses
from swarmdsl.execution.space.functions.vectors import (
    counts,
    lengths,
    near_pairs,
    places,
    sums,
    turned,
    unit,
    unit_or,
)
from swarmdsl.execution.space.hashing import key
from swarmdsl.execution.space.stage import Stage

_NOISE, _CONTACT = key("flock", "noise"), key("flock", "contact")


def reynolds(
    position: Floats,
    heading: Floats,
    first: Rows,
    second: Rows,
    spacing: Floats,
    separation: Floats | float,
    alignment: Floats | float,
    cohesion: Floats | float,
) -> Floats:
    """Return the direction that each robot wants, as a vector of length 1.

    `position` and `heading`, vectors of length 1, have one row a robot. Separation acts between
    robots nearer than `spacing` and grows from 0 there to 1 where they touch; a robot without
    neighbours keeps its heading.
    """
    robots = len(position)
    offset = position[second] - position[first]
    near = np.maximum(0.0, 1.0 - lengths(offset) / spacing[first])
    apart = -sums(first, unit(offset) * near[:, None], robots)
    number = counts(first, robots)
    mean = np.divide(1.0, number, out=np.zeros(robots), where=number > 0)[:, None]
    along = sums(first, heading[second], robots) * mean
    together = unit(sums(first, offset, robots) * mean)
    wanted = heading + separation * apart + alignment * (along - heading) + cohesion * together
    return unit_or(heading, np.where(number[:, None] == 0, heading, wanted))


def vicsek(
    heading: Floats, first: Rows, second: Rows, noise: Floats | float, drawn: Floats
) -> Floats:
    """Return the new heading of each robot: the mean of its neighbours and itself, and noise.

    Headings are rows (x, y) of length 1. `drawn` has a number from 0 up to 1 for each robot, and
    `noise` is the width of the interval of the noise, in radians: eta in the paper.
    """
    mean = unit_or(heading, heading + sums(first, heading[second], len(heading)))
    return turned(mean, noise * (drawn - 0.5))


class Flock(Model):
    """Fly with the robots in reach that do the same; done when its time is over.

    A robot that something stops turns round. It is aborted when it has been alone for a time.
    """

    stops_on_contact = False

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._reach, self._spacing, self._noise, self._period, self._due = np.zeros((5, stage.rows))
        self._separation, self._alignment, self._cohesion = np.zeros((3, stage.rows))
        self._height, self._speed, self._left, self._most_alone, self._alone = np.zeros(
            (5, stage.rows)
        )
        self._count = np.zeros(stage.rows, dtype=np.int64)
        self._rule = np.zeros(stage.rows, dtype=np.bool_)
        self._x, self._y = np.zeros((2, stage.rows))

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Begin in the direction in which each robot looks."""
        stage = self.stage
        self._reach[who], self._spacing[who] = arguments["range"], arguments["spacing"]
        self._separation[who], self._alignment[who] = (
            arguments["separation"],
            arguments["alignment"],
        )
        self._cohesion[who], self._noise[who] = arguments["cohesion"], arguments["noise"]
        self._period[who], self._due[who] = arguments["period"], 0.0
        self._rule[who] = arguments["rule"] == "vicsek"
        self._height[who] = self.height(who, arguments)
        self._speed[who] = np.minimum(self.speed(who, arguments), stage.speed[who])
        self._left[who] = math.inf if arguments["time"] is None else arguments["time"]
        self._most_alone[who] = math.inf if arguments["lost"] is None else arguments["lost"]
        self._alone[who] = 0.0
        self._x[who], self._y[who] = stage.heading_x[who], stage.heading_y[who]

    def step(self, who: Rows, dt: float) -> Small:
        """Choose the directions, if it is time to, and go on."""
        stage = self.stage
        first, second = near_pairs(stage, who, self._reach[who])
        heading = np.stack([self._x[who], self._y[who]], axis=1)
        due = self._due[who] < dt / 2
        if due.any():
            heading = np.where(due[:, None], self._choose(who, heading, first, second), heading)
            self._count[who[due]] += 1
        self._due[who] = np.where(due, self._period[who], self._due[who]) - dt
        touched = stage.touched[who]
        if touched.any():
            back = stage.chance(who, _CONTACT, self._count[who]) + 0.5
            heading = np.where(touched[:, None], turned(heading, back * math.pi), heading)
            self._count[who[touched]] += 1
        self._x[who], self._y[who] = heading[:, 0], heading[:, 1]
        stage.wanted_x[who] = heading[:, 0] * self._speed[who]
        stage.wanted_y[who] = heading[:, 1] * self._speed[who]
        stage.keep_height(who, self._height[who], dt)
        alone = counts(first, len(who)) == 0
        self._alone[who] = np.where(alone, self._alone[who] + dt, 0.0)
        self._left[who] -= dt
        over = self._left[who] < dt / 2
        return statuses(over, ~over & (self._alone[who] > self._most_alone[who]))

    def _choose(self, who: Rows, heading: Floats, first: Rows, second: Rows) -> Floats:
        drawn = self.stage.chance(who, _NOISE, self._count[who])
        noise = self._noise[who]
        aligned = vicsek(heading, first, second, noise, drawn)
        weights = (each[who, None] for each in (self._separation, self._alignment, self._cohesion))
        here = places(self.stage, who)[:, :2]
        steered = reynolds(here, heading, first, second, self._spacing[who], *weights)
        steered = turned(steered, noise * (drawn - 0.5))
        return np.where(self._rule[who, None], aligned, steered)
