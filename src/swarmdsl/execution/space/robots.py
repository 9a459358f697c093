"""Robots of many runs, in arrays.

A row is a robot of a run; those of a run are side by side, in the order of the robots. All that
happens in a row depends on its own run alone, so that a run alone and one of many are the same.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.space.arrays import Flags, Floats, Rows, Whole, Words
from swarmdsl.execution.space.consumption import Consumption
from swarmdsl.execution.space.hashing import key, shares
from swarmdsl.execution.space.layout import Layout, Unit
from swarmdsl.execution.space.placing import places_in
from swarmdsl.execution.space.shapes import Shapes
from swarmdsl.execution.space.targets import TargetsOfRuns
from swarmdsl.execution.space.turning import direction
from swarmdsl.execution.space.weather import Weather

_ROUNDING = 1e-6
"""More than the length of a step can be wrong by, in metres."""


class Robots:
    """Robots of some runs, which have the same layout and different seeds, and what is around."""

    def __init__(self, layout: Layout, seeds: Sequence[int]) -> None:
        self.layout = layout
        self.seeds = tuple(seeds)
        self.step_length = layout.step
        self.dt = layout.step / SECOND
        """Time of a step, in seconds."""
        self.robots = len(layout.units)
        """Number of robots in a run."""
        self.rows = self.robots * len(self.seeds)
        self.shapes = Shapes(layout.edges, layout.rounds, layout.boxes)
        units = layout.units
        self.run: Whole = np.repeat(np.arange(len(self.seeds)), self.robots)
        self.ticks: Whole = np.zeros(len(self.seeds), dtype=np.int64)
        """Number of the step of each run."""
        self.keys: Words = np.array(
            [key(seed, each.robot.name) for seed in self.seeds for each in units], dtype=np.uint64
        )
        """Numbers that stand for a robot and the seed of its run, in random questions."""
        self.radius = self._each(units, [each.body.radius for each in units])
        self.mass = self._each(units, [each.body.mass for each in units])
        self.speed = self._each(units, [each.body.speed for each in units])
        """Greatest speed of each robot, through the air if it flies."""
        self.climb = self._each(units, [each.body.climb for each in units])
        turns = np.minimum(self._each(units, [each.body.turn for each in units]) * self.dt, math.pi)
        self.turn_x, self.turn_y = direction(turns)
        """Cosine and sine of the greatest angle by which each robot turns in a step."""
        self.index: Whole = self._each(units, [each.robot.index for each in units]).astype(np.int64)
        """Number of each robot in its role."""
        self.count: Whole = self._each(units, [each.robot.count for each in units]).astype(np.int64)
        """Number of robots in the role of each robot."""
        roles = list(dict.fromkeys(each.robot.role for each in units))
        self.role: Whole = self._each(
            units, [roles.index(each.robot.role) for each in units]
        ).astype(np.int64)
        """Number of the role of each robot."""
        self.roles = roles
        self.alive: Flags = np.ones(self.rows, dtype=np.bool_)
        self.flies: Flags = self.climb > 0
        self.any_flies = bool(self.flies.any())
        self.x, self.y = self._starts()
        self.home_x, self.home_y = self.x.copy(), self.y.copy()
        """Place where each robot has started."""
        self.z: Floats = np.zeros(self.rows)
        self.vx: Floats = np.zeros(self.rows)
        self.vy: Floats = np.zeros(self.rows)
        self.vz: Floats = np.zeros(self.rows)
        self.heading_x: Floats = np.ones(self.rows)
        """Cosine of the direction in which each robot looks; `heading_y` is its sine."""
        self.heading_y: Floats = np.zeros(self.rows)
        self.wanted_x: Floats = np.zeros(self.rows)
        """Velocity over ground that its functions want for each robot; likewise for y and z."""
        self.wanted_y: Floats = np.zeros(self.rows)
        self.wanted_z: Floats = np.zeros(self.rows)
        self.touched: Flags = np.zeros(self.rows, dtype=np.bool_)
        """True for robots that something has stopped in this step."""
        self.distance: Floats = np.zeros(self.rows)
        """Way that each robot has gone."""
        self.air_speed: Floats = np.zeros(self.rows)
        """Speed through the air, of the rows that have moved last."""
        self.capacity = self._each(
            units, [each.battery.capacity if each.battery else math.inf for each in units]
        )
        """Energy of each full battery, infinite without one."""
        self.energy = self.capacity.copy()
        """Energy left in each battery, infinite without one."""
        self.used: Floats = np.zeros(self.rows)
        """Energy that each robot has used."""
        self.power: Floats = np.zeros(self.rows)
        """Power that each robot has used in the last step."""
        self.charged: Floats = np.zeros(self.rows)
        """Energy that each robot has got from chargers."""
        self.charger: Floats = np.zeros(self.rows)
        """Power of the charger at which each robot stays."""
        self.tank: Floats = np.ones(self.rows)
        """Share of what each robot can spray that it still has."""
        self.consumption = Consumption(layout, len(self.seeds))
        self.bounds = layout.bounds()
        self.weather = Weather(layout)
        self.reach = self.radius + (self.speed + self.weather.strongest) * self.dt + _ROUNDING
        """Distance from its middle that each robot can touch in a step."""
        self.inner = self._inner()
        """Least x and y and greatest x and y of the middle of each robot; None without bounds."""
        self.ceiling = layout.size[2] if layout.size and len(layout.size) > 2 else math.inf
        self.targets = TargetsOfRuns(layout, self.shapes, self.seeds)

    def chance(self, who: Rows, question: int, counts: Whole | int) -> Floats:
        """Return a random number from 0 to less than 1 for each robot; `key` makes a question."""
        return shares(self.keys[who], question, counts)

    # ---- internal

    def _each(self, units: Sequence[Unit], values: Sequence[float]) -> Floats:
        return np.tile(np.array(values, dtype=np.float64), len(self.seeds))

    def _inner(self) -> tuple[Floats, Floats, Floats, Floats] | None:
        if self.bounds is None:
            return None
        low_x, low_y, high_x, high_y = self.bounds
        radius = self.radius
        return low_x + radius, low_y + radius, high_x - radius, high_y - radius

    def _starts(self) -> tuple[Floats, Floats]:
        """Return the first places: points, or random ones in areas or anywhere."""
        x, y = np.zeros(self.rows), np.zeros(self.rows)
        within: dict[str | None, list[int]] = {}
        for number, unit in enumerate(self.layout.units):
            here = np.arange(number, self.rows, self.robots)
            if unit.start is None and self.layout.size is None:
                x[here] = 2.0 * number
            elif unit.start is None or isinstance(unit.start, str):
                within.setdefault(unit.start, []).append(number)
            else:
                x[here], y[here] = unit.start.x, unit.start.y
        for area, numbers in within.items():
            bounds = self.layout.bounds(area)
            assert bounds is not None
            rows = np.flatnonzero(np.isin(np.arange(self.rows) % self.robots, numbers))
            x[rows], y[rows] = places_in(bounds, self.keys[rows], self.radius[rows], self.shapes)
        return x, y
