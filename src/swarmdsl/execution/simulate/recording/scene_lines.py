"""Lines of a recording about the map: who reaches whom by radio, targets, and who sees them."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from swarmdsl.execution.simulate.pictures.run_map import linked_pairs
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND, SECOND
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.simulate.scenario.space import Place
from swarmdsl.execution.simulate.world.world import World

_MOST_LINKED = 60
"""Greatest number of robots whose links are told."""


class SceneLines:
    """Tell, once a second, what has changed on the map, and at once who sees a target first.

    The lines are those of places: `moved`, also `links` with the names of robots that reach each
    other now, `targets` with the place of each and whether it is found, and `saw`.
    """

    def __init__(self, world: World, write: Callable[[str], object]) -> None:
        self._world = world
        self._write = write
        self._next = 0
        self._links: list[list[str]] = []
        self._targets: dict[str, list[Any]] = {}
        self._seen: set[tuple[Robot, str]] = set()

    def moved(self, now: int) -> None:
        """Write a line at the first step in a second, if something has changed."""
        if now < self._next:
            return
        self._next = (now // SECOND + 1) * SECOND
        world = self._world
        changed: dict[str, Any] = {}
        if len(world.robots) <= _MOST_LINKED:
            names = [each.name or "" for each in world.robots]
            pairs = linked_pairs(world, world.robots)
            links = [[names[one], names[other]] for one, other in pairs]
            if links != self._links:
                self._links = changed["links"] = links
        targets = {name: [*_rounded(place), found] for name, place, found in world.space.targets()}
        if targets != self._targets:
            self._targets = changed["targets"] = targets
        if changed:
            self._tell(now, {}, changed)

    def saw(self, robot: Robot, what: str) -> None:
        """Write a line for a target that a robot sees for the first time."""
        place = self._world.space.at(robot)
        if place is None or (robot, what) in self._seen:
            return
        self._seen.add((robot, what))
        name = robot.name or ""
        saw = {"member": name, "target": what}
        self._tell(self._world.clock.now, {name: _rounded(place)}, {"saw": saw})

    def _tell(self, now: int, moved: dict[str, Any], more: dict[str, Any]) -> None:
        line = {"t": now // MILLISECOND, "moved": moved, **more}
        self._write(f"{json.dumps(line, ensure_ascii=False)}\n")


def _rounded(place: Place) -> list[float]:
    return [round(each, 3) for each in place]
