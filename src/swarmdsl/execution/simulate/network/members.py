"""Members of a swarm with a heartbeat: which robots each robot takes for present.

Robots send heartbeats at the multiples of their period. They are not simulated one by one: what a
robot hears is computed when another one is lost, cut off, or comes back.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from swarmdsl.codegen.shared.identity import counts_neighbors, follows_members
from swarmdsl.execution.simulate.scenario.clock import Alarm, Clock
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.ir import Heartbeat, System

JOINED, DEPARTED = "member_joined", "member_lost"
"""Events of robots that are heard again, and of robots that are not heard any more."""


def following(system: System | None) -> frozenset[str]:
    """Return the names of the machines that handle events of members, or count them."""
    machines = system.machines if system is not None else ()
    return frozenset(machine.name for machine in machines if follows_members(machine))


def counting_neighbors(system: System | None) -> frozenset[str]:
    """Return the names of the machines that ask how many robots are near."""
    machines = system.machines if system is not None else ()
    return frozenset(machine.name for machine in machines if counts_neighbors(machine))


class Roster:
    """Robots that one robot takes for present; at the start, all of them."""

    def __init__(self, robots: Iterable[Robot]) -> None:
        self._sizes = Counter(robot.role for robot in robots)
        self._missing: dict[str, str] = {}
        """Roles of the robots that are not present, by their names."""

    def count(self, role: str | None) -> int:
        """Return the number of present robots of a role, or of all roles."""
        size = self._sizes.total() if role is None else self._sizes[role]
        return size - sum(role in (None, of) for of in self._missing.values())

    def note(self, event: str, data: Any) -> None:
        """Follow an event about a member."""
        given = data if isinstance(data, Mapping) else {}
        name, role = str(given.get("id")), str(given.get("role"))
        if event == DEPARTED and self._sizes[role]:
            self._missing[name] = role
        elif event == JOINED:
            self._missing.pop(name, None)

    def clear(self) -> None:
        """Take all robots for present, as at the start."""
        self._missing.clear()

    @property
    def missing(self) -> Iterable[str]:
        """Roles of the robots that are not present, one for each of these."""
        return self._missing.values()

    def misses(self, robot: Robot) -> bool:
        """Return True if a robot is not present."""
        return robot.name in self._missing


class Members:
    """Tell robots which others are lost, and which are there again.

    `reaches(one, other)` says whether a heartbeat gets from one robot to another, `tell` raises an
    event of a member in a robot.
    """

    def __init__(
        self,
        clock: Clock,
        heartbeat: Heartbeat | None,
        robots: Sequence[Robot],
        observers: Sequence[Robot],
        reaches: Callable[[Robot, Robot], bool],
        tell: Callable[[str, Robot, Robot], None],
    ) -> None:
        self.rosters = {robot: Roster(robots) for robot in observers}
        self._clock = clock
        self._heartbeat = heartbeat
        self._robots = robots
        self._observers = observers if heartbeat is not None else ()
        self._reaches = reaches
        self._tell = tell
        self._losses: dict[tuple[Robot, Robot], Alarm] = {}
        """Ends of silences that are not long enough yet."""
        self._hearings: dict[tuple[Robot, Robot], tuple[int, Alarm]] = {}
        """Next heartbeats after a silence, with their times."""

    @property
    def is_followed(self) -> bool:
        """True if a robot follows who is there, by heartbeats."""
        return bool(self._observers)

    def follow(self, robots: Sequence[Robot] | None = None) -> None:
        """Follow a change of what some robots reach, or all of them."""
        changed = {robot.name for robot in (self._robots if robots is None else robots)}
        for observer in self._observers:
            others = self._robots if robots is None or observer.name in changed else robots
            for other in others:
                if other is not observer and self._reaches(observer, observer):
                    self._follow(observer, other)

    def forget(self, observer: Robot) -> None:
        """Forget what a robot knows: if it starts anew, it takes all others for present."""
        for pair in [pair for pair in self._losses if pair[0] is observer]:
            self._clock.unschedule(self._losses.pop(pair))
        for pair in [pair for pair in self._hearings if pair[0] is observer]:
            self._clock.unschedule(self._hearings.pop(pair)[1])
        if observer in self.rosters:
            self.rosters[observer].clear()

    def follow_pair(self, observer: Robot, other: Robot) -> None:
        """Follow a change of whether a robot hears another one."""
        if observer in self._observers and self._reaches(observer, observer):
            self._follow(observer, other)

    # ---- internal

    def _follow(self, observer: Robot, other: Robot) -> None:
        assert self._heartbeat is not None
        pair, now, period = (observer, other), self._clock.now, self._heartbeat.period
        is_missed = self.rosters[observer].misses(other)
        if self._reaches(observer, other):
            if (is_missed or pair in self._losses) and pair not in self._hearings:
                wait = -now % period
                alarm = self._clock.schedule(wait, lambda: self._hear(pair))
                self._hearings[pair] = (now + wait, alarm)
            return
        if pair in self._hearings:
            self._clock.unschedule(self._hearings.pop(pair)[1])
        if not is_missed and pair not in self._losses:
            wait = self._heartbeat.timeout - now % period
            self._losses[pair] = self._clock.schedule(wait, lambda: self._lose(pair))

    def _hear(self, pair: tuple[Robot, Robot]) -> None:
        """End a silence."""
        del self._hearings[pair]
        if pair in self._losses:
            self._clock.unschedule(self._losses.pop(pair))
        elif self.rosters[pair[0]].misses(pair[1]):
            self._tell(JOINED, *pair)

    def _lose(self, pair: tuple[Robot, Robot]) -> None:
        """Give up a robot, unless its heartbeat arrives at this moment."""
        if pair in self._hearings and self._hearings[pair][0] == self._clock.now:
            return
        del self._losses[pair]
        self._tell(DEPARTED, *pair)
