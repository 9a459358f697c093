"""Ports on which robots tell their own state, once a second: battery, pose, range ahead."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.simulate.scenario.space import Surroundings
from swarmdsl.execution.space.building import BATTERY, RANGE
from swarmdsl.execution.space.layout import Gauge
from swarmdsl.execution.space.messages import Facts
from swarmdsl.ir import Type

if TYPE_CHECKING:
    from swarmdsl.execution.space.stage import Stage

_FARTHEST = 30.0
"""Distance in metres up to which a robot measures the range ahead."""


class Gauges:
    """Messages of the robots of a run about themselves, where somebody hears them."""

    def __init__(self, stage: Stage, first: int, robots: Mapping[str | None, Robot]) -> None:
        self._stage = stage
        self._first = first
        self.every = max(round(SECOND / stage.step_length), 1)
        """Number of steps between two readings."""
        self._read = [
            (place, robots[unit.robot.name], gauge)
            for place, unit in enumerate(stage.layout.units)
            for gauge in unit.gauges
            if unit.robot.name in robots
        ]
        self.is_needed = bool(self._read)

    def read(self, world: Surroundings, now: int) -> Iterator[tuple[Robot, str, Type, Facts]]:
        """Yield what is told now: the robot, the topic, and the type and facts of the message."""
        for place, robot, gauge in self._read:
            row = self._first + place
            if self._stage.alive[row] and world.awaits(robot, gauge.topic):
                yield robot, gauge.topic, gauge.type, self._facts(row, place, gauge, now)

    def _facts(self, row: int, place: int, gauge: Gauge, now: int) -> Facts:
        stage = self._stage
        if gauge.kind == BATTERY:
            battery = stage.layout.units[place].battery
            assert battery is not None
            return Facts(now, charge=float(stage.energy[row]) / (battery.capacity or 1.0))
        x, y, z = float(stage.x[row]), float(stage.y[row]), float(stage.z[row])
        heading = float(stage.heading_x[row]), float(stage.heading_y[row])
        if gauge.kind == RANGE:
            return Facts(now, distance=self._ahead(row))
        return Facts(now, (x, y, z), heading)

    def _ahead(self, row: int) -> float:
        """Return the distance to what is in front of a robot."""
        stage = self._stage
        who = np.array([row])
        low, high = 0.0, _FARTHEST
        if not self._is_blocked(who, high):
            return high
        for _ in range(20):
            middle = (low + high) / 2
            low, high = (low, middle) if self._is_blocked(who, middle) else (middle, high)
        return max(high - float(stage.radius[row]), 0.0)

    def _is_blocked(self, who: np.ndarray, distance: float) -> bool:
        stage = self._stage
        x, y, z = stage.x[who], stage.y[who], stage.z[who]
        end_x = x + stage.heading_x[who] * distance
        end_y = y + stage.heading_y[who] * distance
        if stage.bounds is not None:
            low_x, low_y, high_x, high_y = stage.bounds
            if not (low_x <= end_x[0] <= high_x and low_y <= end_y[0] <= high_y):
                return True
        return bool(stage.shapes.crossings((x, y), (end_x, end_y), (z, z))[0])
