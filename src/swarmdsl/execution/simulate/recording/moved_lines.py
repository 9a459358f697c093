"""Lines of a trace that tell where robots are, between the lines of their steps."""

from __future__ import annotations

import json
from collections.abc import Callable

from swarmdsl.execution.simulate.scenario.durations import MILLISECOND, SECOND
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.simulate.scenario.space import Place
from swarmdsl.execution.simulate.world.world import World


class MovedLines:
    """Write, once a second, where the robots are that have moved since."""

    def __init__(self, world: World, write: Callable[[str], object]) -> None:
        self._world = world
        self._write = write
        self._told: dict[Robot, Place | None] = {}

    def moved(self, now: int) -> None:
        """Write a line at a whole second, if somebody has moved."""
        if now % SECOND:
            return
        moved = {}
        for robot in self._world.robots:
            place = self._world.space.at(robot)
            if place is not None and place != self._told.get(robot):
                self._told[robot] = place
                moved[robot.name or ""] = [round(each, 3) for each in place]
        if moved:
            line = {"t": now // MILLISECOND, "moved": moved}
            self._write(f"{json.dumps(line, ensure_ascii=False)}\n")

    def saw(self, robot: Robot, what: str) -> None:
        """Write nothing: what is seen has lines of its own where somebody hears it."""
