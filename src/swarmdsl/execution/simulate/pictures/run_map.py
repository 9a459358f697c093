"""Record where robots are in a run, and draw the map of it, at a moment or in motion."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Protocol

from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.network.network import Network
from swarmdsl.execution.simulate.pictures.map_animation import Film, map_animation, timing_of
from swarmdsl.execution.simulate.pictures.map_svg import (
    Ground,
    Mark,
    Moment,
    Place,
    Sighting,
    Track,
    map_svg,
)
from swarmdsl.execution.simulate.pictures.player import player
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.simulate.scenario.space import Space
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.ir import Environment
from swarmdsl.ir.space import Point

_MARGIN = 2.0
"""Room in metres around robots of an environment without a size."""
_MOST_LINKED = 100
"""Greatest number of robots whose links are noted in each second."""


class Filmed(Protocol):
    """Parts of a world that are on its map."""

    clock: Clock
    robots: list[Robot]
    space: Space
    network: Network


class Maps:
    """Files with the map of a run: a picture of its end, and one in motion."""

    def __init__(self, map_: Path | None, animation: Path | None) -> None:
        self._map, self._animation = map_, animation
        self.paths = [each for each in (map_, animation) if each is not None]

    def record(self, subject: Subject, world: Filmed) -> RunMap:
        """Begin to record a run."""
        return RunMap(subject, world, filmed=self._animation is not None)

    def drawn(self, recorded: RunMap) -> list[str]:
        """Return the contents of the files."""
        found = [recorded.svg()] if self._map is not None else []
        if self._animation is not None:
            found.append(recorded.animation(self._animation.suffix.lower()))
        return found


class RunMap:
    """Trails of robots, a place a second, and from where each has first seen each target.

    If it is `filmed`, also who reached whom by radio, and when targets were found or moved.
    """

    def __init__(self, subject: Subject, world: Filmed, *, filmed: bool = False) -> None:
        self._subject = subject
        self._world = world
        self._filmed = filmed
        self._trails: dict[Robot, list[tuple[int, Place]]] = {each: [] for each in world.robots}
        self._seen: dict[tuple[str, str], Sighting] = {}
        self._next = 0
        self._absences: dict[Robot, list[tuple[int, int | None]]] = {
            each: [] for each in world.robots
        }
        self._gone: set[Robot] = set()
        """Robots that are lost now."""
        self._carried: dict[str, list[tuple[int, Place]]] = {}
        """Places of each target, when it was moved."""
        self._found: dict[str, int] = {}
        self._linked: dict[tuple[int, int], int] = {}
        """Links of now, with the time from which on they are there."""
        self._links: list[tuple[int, int, int, int]] = []
        world.space.viewers += (self,)

    # ---- what happens

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

    def stepped(self, line: Line) -> None:
        """Note who is lost or comes back, with a line of the trace."""
        self._note_absences(line.time)

    # ---- pictures

    def svg(self) -> str:
        """Draw the map of the run until now."""
        world = self._world
        now = world.clock.now
        tracks = [
            Track(robot.name or "", robot.role, self._until(robot, now), self._is_gone(robot))
            for robot in self._trails
        ]
        marks = [Mark(*each) for each in world.space.targets()]
        links = [
            (tracks[one].places[-1][1], tracks[other].places[-1][1]) for one, other in self._pairs()
        ]
        moment = Moment(now, tracks, marks, links, list(self._seen.values()))
        return map_svg(self._subject.name, self._ground(tracks), moment)

    def animation(self, suffix: str) -> str:
        """Draw the run until now in motion, as SVG or as a page that plays it."""
        self._note(now := self._world.clock.now)
        tracks = [
            Track(robot.name or "", robot.role, places) for robot, places in self._trails.items()
        ]
        targets = [
            (Track(name, "", places), self._found.get(name))
            for name, places in self._carried.items()
        ]
        links = [*self._links, *((*pair, start, now) for pair, start in self._linked.items())]
        links.sort(key=lambda link: (link[2], link))
        seen = list(self._seen.values())
        film = Film(now, tracks, list(self._absences.values()), targets, links, seen)
        title = self._subject.name
        svg = map_animation(title, self._ground(tracks), film)
        return player(title, svg, timing_of(now)) if suffix == ".html" else svg

    # ---- internal

    def _ground(self, tracks: list[Track]) -> Ground:
        places = (place for track in tracks for _, place in track.places)
        return ground_of(self._subject.environment, places)

    def _until(self, robot: Robot, now: int) -> list[tuple[int, Place]]:
        """Return the trail of a robot, up to where it is now."""
        places, place = self._trails[robot], self._world.space.at(robot)
        if place is None or (places and places[-1][0] >= now):
            return places
        return [*places, (now, place)]

    def _note(self, now: int) -> None:
        for robot, places in self._trails.items():
            place = self._world.space.at(robot)
            if place is not None and (not places or places[-1][0] < now):
                places.append((now, place))
        self._note_absences(now)
        if self._filmed:
            self._note_links(now)
            self._note_targets(now)

    def _note_absences(self, now: int) -> None:
        gone = self._world.network.gone
        if gone == self._gone:
            return
        for robot in gone ^ self._gone:
            absences = self._absences[robot]
            if robot in gone:
                absences.append((now, None))
            else:
                absences[-1] = (absences[-1][0], now)
        self._gone = set(gone)

    def _note_links(self, now: int) -> None:
        pairs = set(self._pairs()) if len(self._trails) <= _MOST_LINKED else set()
        for pair in [each for each in self._linked if each not in pairs]:
            self._links.append((*pair, self._linked.pop(pair), now))
        for pair in pairs:
            self._linked.setdefault(pair, now)

    def _note_targets(self, now: int) -> None:
        for name, place, found in self._world.space.targets():
            places = self._carried.setdefault(name, [])
            if not places or places[-1][1] != place:
                if places and places[-1][0] < now - SECOND:
                    places.append((now - SECOND, places[-1][1]))
                places.append((now, place))
            if found:
                self._found.setdefault(name, now)

    def _pairs(self) -> Iterator[tuple[int, int]]:
        return linked_pairs(self._world, list(self._trails))

    def _is_gone(self, robot: Robot) -> bool:
        return robot in self._world.network.gone


def linked_pairs(world: Filmed, robots: Sequence[Robot]) -> Iterator[tuple[int, int]]:
    """Yield the numbers of robots that reach each other, if there are radios."""
    if not world.space.has_radio:
        return
    network = world.network
    there = [each for each in enumerate(robots) if each[1] not in network.gone]
    for number, (one, first) in enumerate(there):
        for other, second in there[number + 1 :]:
            if network.reaches(first, second) and network.reaches(second, first):
                yield one, other


def ground_of(environment: Environment | None, places: Iterable[Place]) -> Ground:
    """Return the geometry of an environment; without a size, that around the places of robots."""
    if environment is None or environment.size is None:
        found = list(places)
        low, high = (
            Point(pick(x for x, _, _ in found), pick(y for _, y, _ in found)) for pick in (min, max)
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
