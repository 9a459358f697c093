"""Record where robots are in a run, and draw the map of it."""

from __future__ import annotations

from swarmdsl.execution.simulate.durations import SECOND
from swarmdsl.execution.simulate.map_svg import (
    Ground,
    Mark,
    Moment,
    Place,
    Sighting,
    Track,
    map_svg,
)
from swarmdsl.execution.simulate.scenario import Robot
from swarmdsl.execution.simulate.subject import Subject
from swarmdsl.execution.simulate.world import World
from swarmdsl.ir.space import Point

_MARGIN = 2.0
"""Room in metres around robots of an environment without a size."""


class RunMap:
    """Trails of robots, a place a second, and from where each has first seen each target."""

    def __init__(self, subject: Subject, world: World) -> None:
        self._subject = subject
        self._world = world
        self._trails: dict[Robot, list[tuple[int, Place]]] = {each: [] for each in world.robots}
        self._seen: dict[tuple[str, str], Sighting] = {}
        self._next = 0
        world.space.viewers += (self,)

    def moved(self, now: int) -> None:
        """Note where all robots are, once a second."""
        if now >= self._next:
            self._next = (now // SECOND + 1) * SECOND
            self._note(now)

    def saw(self, robot: Robot, what: str) -> None:
        """Note that a robot sees a target."""
        name = robot.name or ""
        place = self._world.space.at(robot)
        if (name, what) not in self._seen and place is not None:
            now = self._world.clock.now
            self._seen[name, what] = Sighting(now, name, what, place)

    def svg(self) -> str:
        """Draw the map of the run until now."""
        world = self._world
        self._note(world.clock.now)
        tracks = [
            Track(robot.name or "", robot.role, places, robot in world.network.gone)
            for robot, places in self._trails.items()
        ]
        marks = [Mark(*each) for each in world.space.targets()]
        moment = Moment(world.clock.now, tracks, marks, self._links(), list(self._seen.values()))
        return map_svg(self._subject.name, self._ground(), moment)

    def _note(self, now: int) -> None:
        for robot, places in self._trails.items():
            place = self._world.space.at(robot)
            if place is not None and (not places or places[-1][0] < now):
                places.append((now, place))

    def _links(self) -> list[tuple[Place, Place]]:
        """Return the places of robots that reach each other, if there are radios."""
        world = self._world
        if not world.space.has_radio:
            return []
        there = [robot for robot in self._trails if robot not in world.network.gone]
        return [
            (self._trails[one][-1][1], self._trails[other][-1][1])
            for number, one in enumerate(there)
            for other in there[number + 1 :]
            if world.network.reaches(one, other) and world.network.reaches(other, one)
        ]

    def _ground(self) -> Ground:
        environment = self._subject.environment
        if environment is None or environment.size is None:
            places = [place for places in self._trails.values() for _, place in places]
            low, high = (
                Point(pick(x for x, _, _ in places), pick(y for _, y, _ in places))
                for pick in (min, max)
            )
            low = Point(low.x - _MARGIN, low.y - _MARGIN)
            high = Point(high.x + _MARGIN, high.y + _MARGIN)
        else:
            low, high = Point(0.0, 0.0), Point(environment.size[0], environment.size[1])
        if environment is None:
            return Ground(low, high)
        return Ground(
            low,
            high,
            [(each.name, each.box) for each in environment.areas],
            [(each.name, each.box) for each in environment.zones],
            [each.points for each in environment.walls],
            [(each.name or "", each.shape) for each in environment.obstacles],
        )
