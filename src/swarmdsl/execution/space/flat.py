"""Flat space of one run: where robots are, and what its world learns of a step."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from swarmdsl.execution.engine import ExecutionError, LoopError, Run
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.simulate.scenario.space import Ended, ModelError, Place, Space, Surroundings
from swarmdsl.execution.space.arrays import Whole
from swarmdsl.execution.space.functions.base import OUTCOMES, Finding
from swarmdsl.execution.space.gauges import Gauges
from swarmdsl.execution.space.messages import Facts
from swarmdsl.execution.space.sensing import Sighting
from swarmdsl.execution.space.shared_stage import Key, SharedStage

EMPTY = "battery empty"
"""Reason of the loss of a robot."""


class Happened(NamedTuple):
    """Events of a run in one step."""

    empty: list[int]
    seen: list[Sighting]
    ended: list[tuple[int, Key, int]]


NOTHING = Happened([], [], [])


class FlatSpace(Space):
    """Flat space of one run."""

    def __init__(
        self, shared: SharedStage, number: int, advance: Callable[[], None] | None
    ) -> None:
        self._advance = advance
        """Called when it is due; None if somebody waits for all that are."""
        self.number = number
        """Number of the run in its ensemble."""
        self.follows_links = False
        self.step_number = 0
        self.failure: LoopError | None = None
        """Failure of the world of this space alone, when it moved on with others."""
        self.has_radio = shared.links.is_needed
        self._shared = shared
        self._stage = shared.stage
        self._places = {
            unit.robot.name: place for place, unit in enumerate(self._stage.layout.units)
        }
        self._first = number * self._stage.robots
        self._runs: dict[tuple[int, Key], list[Run]] = {}
        """Runs of each function in each robot; the last one is going on."""
        self._of: dict[Run, tuple[int, Key]] = {}
        self._reached: Whole = np.empty(0, dtype=np.int64)
        self._ticking = False
        self._always = (
            self._stage.consumption.is_needed
            or self._stage.eyes.is_needed
            or self._stage.weather.blows
        )

    # ---- called by a world

    def check(self) -> None:
        """Raise the error of a machine that has failed when this space moved on with others."""
        if self.failure is not None:
            raise self.failure

    def begin(self, world: Surroundings, ended: Ended) -> None:
        """Begin with a world, at its time 0."""
        self._world = world
        self._ended = ended
        self._robots = {robot.name: robot for robot in world.robots}
        self._gauges = Gauges(self._stage, self._first, self._robots)
        self.follows_links = self.has_radio and world.minds_links
        if self.follows_links:
            self._reached = self._own(self._shared.links.within())
            world.links_changed(
                (one, other)
                for one in world.robots
                for other in world.robots
                if one is not other and not self.reaches(one, other)
            )
        self._wake()

    def start(self, run: Run, robot: Robot) -> bool:
        """Start a function if it has a model, unless its arguments have no value."""
        use = self._shared.setting.use(run.activity.name, robot)
        if use is None:
            return False
        row = self._first + self._places[robot.name]
        key = (use.function, use.kind.name)
        try:
            arguments = use.arguments(run.goal)
        except (ExecutionError, ArithmeticError, ValueError) as error:
            self._world.failed(run.instance, error)
            self._world.clock.schedule(0, lambda: self._ended(run, "aborted", {}))
            return True
        running = self._shared.running(use)
        if running.active[row]:
            running.stop(row)
        running.start(row, arguments)
        self._runs.setdefault((row, key), []).append(run)
        self._of[run] = (row, key)
        self._wake()
        return True

    def stop(self, run: Run) -> None:
        """Stop a function; of two calls in a robot, the last one decides."""
        place = self._of.pop(run, None)
        if place is None:
            return
        runs = self._runs[place]
        was_last = runs[-1] is run
        runs.remove(run)
        if not runs:
            del self._runs[place]
        if was_last:
            self._shared.functions[place[1]].stop(place[0])

    def lose(self, robot: Robot) -> None:
        """Let a robot lie where it is; one that flies falls."""
        row = self._row(robot)
        stage = self._stage
        stage.alive[row] = False
        stage.motion.lose(row)
        stage.halt(np.array([row]))
        stage.targets.release(row)
        stage.moved()
        if self._drifts:
            self._wake()

    def restore(self, robot: Robot) -> None:
        """Let a lost robot go on where it is."""
        self._stage.alive[self._row(robot)] = True
        self._stage.motion.restore(self._row(robot))
        self._stage.moved()
        self._wake()

    def reaches(self, one: Robot, other: Robot) -> bool:
        """Return True if radio gets from one robot to another."""
        if not self.has_radio or one is other:
            return True
        places = self._places[one.name], self._places[other.name]
        return self._shared.links.reaches(self.number, *places)

    def loss(self, one: Robot, other: Robot) -> float:
        """Return the probability that an event gets lost on its way."""
        places = self._places[one.name], self._places[other.name]
        return self._shared.links.loss(self.number, *places)

    def neighbors(self, robot: Robot, distance: float) -> int:
        """Return the number of other robots within a distance, that are there."""
        stage, row = self._stage, self._row(robot)
        here = self._here
        dx, dy = stage.x[here] - stage.x[row], stage.y[here] - stage.y[row]
        dz = stage.z[here] - stage.z[row]
        near = (dx * dx + dy * dy + dz * dz <= distance * distance) & stage.alive[here]
        return int(np.count_nonzero(near)) - bool(stage.alive[row])

    def at(self, robot: Robot) -> Place:
        """Return where a robot is."""
        stage, row = self._stage, self._row(robot)
        return float(stage.x[row]), float(stage.y[row]), float(stage.z[row])

    def measure(self, kind: str, subject: str) -> float | None:
        """Return the distance, energy or covered share of a role, or the targets found."""
        stage = self._stage
        if kind == "found":
            return stage.targets.found(subject, self.number)
        if subject not in stage.roles:
            return None
        if kind == "covered":
            return stage.covering.share(self.number, subject)
        here = self._here
        of = stage.role[here] == stage.roles.index(subject)
        values = {"distance": stage.distance, "energy": stage.used}[kind]
        return math.fsum(values[here][of].tolist())

    def targets(self) -> list[tuple[str, Place, bool]]:
        """Return the targets: name, place, and whether somebody has seen it."""
        return self._stage.targets.of_run(self.number)

    def picture(self) -> bytes | None:
        """Return a picture of the robots as PNG, None if what moves them has none."""
        return self._stage.motion.picture(self.number)

    def rows(self) -> list[tuple[str, ...]]:
        """Return the lines of the summary: distance, energy and coverage, where there are any."""
        stage = self._stage
        energy, covers = stage.consumption.is_needed, stage.covering.is_noted
        head = ["member", "distance"]
        head += ["energy used", "energy left"] if energy else []
        head += ["covered first"] if covers else []
        lines = [tuple(head)]
        for robot in self._world.robots:
            row = self._row(robot)
            line = [robot.name or "", f"{stage.distance[row]:.1f} m"]
            if energy:
                capacity = stage.layout.units[row - self._first].battery
                full = capacity.capacity if capacity else 0.0
                line += [f"{stage.used[row] / 3600:.2f} Wh"]
                line += [f"{100 * (stage.energy[row] / full):.1f} %" if full else "-"]
            if covers:
                line += [f"{100 * stage.covering.first(row):.1f} %"]
            lines.append(tuple(line))
        if covers and len(lines) > 2:
            line = ["together", f"{math.fsum(stage.distance[self._here].tolist()):.1f} m"]
            if energy:
                line += [f"{math.fsum(stage.used[self._here].tolist()) / 3600:.2f} Wh", ""]
            lines.append((*line, f"{100 * stage.covering.share(self.number):.1f} %"))
        return lines

    # ---- steps

    def goes_on(self) -> bool:
        """Go on to the time of the next step, if nothing else happens until then."""
        clock, number = self._world.clock, self.step_number + 1
        time = number * self._stage.step_length
        if time > self.limit or not (self._always or self._of or self._drifts):
            return False
        if self._gauges.is_needed and self.step_number % self._gauges.every == 0:
            return False
        following = clock.next
        if following is not None and following <= time:
            return False
        clock.now, self.step_number = time, number
        return True

    def react(self, happened: Happened, links: Whole | None) -> None:
        """Let the world know what has happened with a step."""
        self._ticking = False
        world, stage = self._world, self._stage
        for row in happened.empty:
            world.lose(self._robot(row), reason=EMPTY)
        if links is not None and self.follows_links:
            self._follow(self._own(links))
        for sighting in happened.seen:
            self._tell(sighting)
        for row, key, status in happened.ended:
            runs = self._runs.get((row, key))
            if runs and self._shared.functions[key].active[row]:
                self._end(row, key, status, runs[-1])
        if stage.ticks[self.number] % self._gauges.every == 0:
            for robot, topic, type_, facts in self._gauges.read(world, world.clock.now):
                world.publish(robot, topic, self._shared.messages.message(type_, facts))
        self._wake()
        world.flush()

    # ---- internal

    def _wake(self) -> None:
        """Schedule the next step, if anything can change until then."""
        needed = self._always or self._of or self._gauges.is_needed
        if self._ticking or not (needed or self._drifts):
            return
        self._ticking = True
        length = self._stage.step_length
        self._world.clock.schedule(length - self._world.clock.now % length, self._tick)

    def _tick(self) -> None:
        self.step_number = self._world.clock.now // self._stage.step_length
        self.due = True
        if self._advance is not None:
            self._advance()

    @property
    def _drifts(self) -> bool:
        """True if robots move that do not want to."""
        return not self._stage.motion.rests(self.number)

    @property
    def _here(self) -> slice:
        """Rows of this run."""
        return slice(self._first, self._first + self._stage.robots)

    def _row(self, robot: Robot) -> int:
        return self._first + self._places[robot.name]

    def _robot(self, row: int) -> Robot:
        robot = self._stage.layout.units[row - self._first].robot
        return self._robots.get(robot.name, robot)

    def _own(self, links: Whole) -> Whole:
        """Return the links of this run."""
        stage = self._stage
        ends = np.array([self._first, self._first + stage.robots]) * stage.rows
        low, high = np.searchsorted(links, ends)
        return links[low:high]

    def _follow(self, links: Whole) -> None:
        if np.array_equal(links, self._reached):
            return
        changed = np.setxor1d(links, self._reached, assume_unique=True)
        self._reached = links
        rows = self._stage.rows
        self._world.links_changed(
            [
                (self._robot(number // rows), self._robot(number % rows))
                for number in changed.tolist()
            ]
        )

    def _tell(self, sighting: Sighting) -> None:
        """Publish what a sensor sees."""
        stage, world = self._stage, self._world
        eye = stage.layout.units[sighting.row - self._first].eyes[sighting.eye]
        robot = self._robot(sighting.row)
        name = stage.targets.names[sighting.target % stage.targets.count]
        for viewer in self.viewers:
            viewer.saw(robot, name)
        if eye.topic is None or eye.type is None:
            return
        if not stage.alive[sighting.row] or not world.awaits(robot, eye.topic):
            return
        place = (sighting.x, sighting.y, sighting.z)
        here = self.at(robot)
        distance = float(np.sqrt(sum((a - b) * (a - b) for a, b in zip(place, here, strict=True))))
        facts = Facts(world.clock.now, place, id=name, distance=distance)
        world.publish(robot, eye.topic, self._shared.messages.message(eye.type, facts))

    def _end(self, row: int, key: Key, status: int, run: Run) -> None:
        outcome = OUTCOMES.get(status)
        if outcome is None:
            raise ModelError(key[0], f"`step` returns status {status}, which is none")
        fields: dict[str, Any] = {}
        system = self._shared.setting.system
        if outcome == "succeeded":
            found = self._shared.functions[key].result(row)
            if isinstance(found, Finding):
                facts = Facts(
                    self._world.clock.now, found.place, found.heading, found.id, found.distance
                )
                fields = self._shared.messages.result(system.function(key[0]), facts)
            else:
                fields = dict(found)
        self._ended(run, outcome, fields)
