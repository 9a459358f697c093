"""Runs that go on for ever, of real robots: a loop that can be repeated as it is.

A search finds a loop of numbers of robots. Here robots with names take its steps on the engine,
again and again, until each of them is where it was, and all that was running is over. Times of
the loop fit all delays in each lap: they are difference constraints with the length of the lap.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from swarmdsl.base.records import dataclass, replace
from swarmdsl.execution.monitor import FALSE, Watch
from swarmdsl.execution.simulate.evaluation.properties import plan
from swarmdsl.execution.simulate.evaluation.properties import watch as watched
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.verify.replay.copies import Robot
from swarmdsl.execution.verify.replay.lasso_times import lap_times
from swarmdsl.execution.verify.replay.play import Play, play
from swarmdsl.execution.verify.replay.spurious import ELSEWHERE, VIEWS, exceeding
from swarmdsl.execution.verify.replay.times import in_step
from swarmdsl.execution.verify.search.lassos import Lasso
from swarmdsl.execution.verify.search.run import Run
from swarmdsl.execution.verify.swarm.network import Network
from swarmdsl.ir import Property

_MOST_LAPS = 12
"""Laps after which robots are where they were in an earlier one."""
_MOST_EXTRA = 3
"""Laps that may be different in time before the loop begins."""
_UNFAIR = "what is running on one of the robots is never over in it"


def endless(network: Network, lasso: Lasso, property_: Property, robot: str | None) -> Run:
    """Run a lasso on the engine: it violates a property, of one robot if it is about each."""
    if any(g.automaton.whole.kind.is_deaf for g in network.groups):
        return Run((), flaw=VIEWS)
    if not lasso.loop:
        return replace(play(network, lasso.stem, property_, is_whole=True), loop=0)
    found = repeated(network, lasso)
    if isinstance(found, str):
        return Run((), flaw=found)
    for extra in range(_MOST_EXTRA):
        stem = found.stem + found.loop * extra
        probe = _Laps(network, [0] * (len(stem) + 2 * len(found.loop) + 1))
        probe.run(stem + found.loop * 2)
        fitting = _fitting(probe, len(stem), len(found.loop))
        if fitting is not None:
            return _timed(network, Lasso(stem, found.loop), fitting, property_, robot)
    return Run((), flaw="no times of its loop fit all delays")


def _fitting(laps: _Laps, before: int, steps: int) -> list[int] | None:
    """Return times of the steps before two laps and of the first one, and the length of a lap."""
    return in_step(
        lambda more: lap_times(before, steps, [*laps.constraints(), *more]), laps.beats()
    )


def repeated(network: Network, lasso: Lasso, *, fair: bool = True) -> Lasso | str:
    """Return a lasso after whose loop each robot is where it was, or why there is none.

    If it must be `fair`, all that was running before the loop is over after it.
    """
    stem, loop = list(lasso.stem), list(lasso.loop)
    laps = _Laps(network, [0] * (len(stem) + _MOST_LAPS * len(loop) + 1))
    laps.run(stem)
    marks = [laps.mark()]
    for last in range(1, _MOST_LAPS + 1):
        laps.go_on(loop)
        if laps.departs:
            return laps.departs
        if laps.exceeds or laps.late:
            return exceeding(network.capacity, laps.exceeds or laps.late)
        if laps.overtakes:
            return f"an event overtakes an earlier one on `{laps.overtakes}`"
        marks.append(laps.mark())
        for first in range(last):
            if marks[last].follows(marks[first], fair=fair):
                return Lasso(stem + loop * first, loop * (last - first))
    return _UNFAIR


def _timed(
    network: Network, lasso: Lasso, times: Sequence[int], property_: Property, robot: str | None
) -> Run:
    """Run two laps at given times: the property stays open at each of their lines.

    `times` are those of the first lap and the steps before, and the length of a lap.
    """
    *first, length = times
    times = [*first, *(time + length for time in first[len(lasso.stem) + 1 :])]
    laps = _Laps(network, times)
    laps.run(lasso.stem)
    before, lost_before = len(laps.lines), len(laps.lost)
    laps.go_on(lasso.loop)
    end = len(laps.lines)
    laps = _Laps(network, times)
    laps.ask(property_, robot, before, 2 * (end - before))
    laps.run(lasso.stem + lasso.loop)
    lost = tuple(laps.lost)
    laps.go_on(lasso.loop)
    if laps.departs or list(_shown(laps.lines[before:end])) != list(_shown(laps.lines[end:])):
        return Run((), flaw=ELSEWHERE)
    if not laps.is_open:
        return Run((), flaw="the monitor does not see a violation in it")
    causes = {line: cause for line, cause in laps.causes.items() if line < end}
    gone = tuple(laps.gone)
    return Run(
        tuple(laps.lines[:end]),
        lost,
        gone,
        loop=end - before,
        causes=causes,
        period=length,
        lost_before=lost_before,
    )


def _shown(lines: Sequence[Line]) -> Iterator[tuple[Any, ...]]:
    for line in lines:
        yield (
            *(line.actor.name, line.event, tuple(line.taken), tuple(line.configuration)),
            *(tuple(line.sent), tuple(line.started), line.ignored),
        )


@dataclass(frozen=True)
class _Mark:
    """Place of all robots, and what is running; `tasks` are objects that stand for it."""

    places: tuple[Any, ...]
    tasks: tuple[object, ...]

    def follows(self, other: _Mark, *, fair: bool) -> bool:
        """Return True if all are where they were.

        If it must be `fair`, nothing is left of what was running.
        """
        old = {id(each) for each in other.tasks} if fair else set()
        return self.places == other.places and not any(id(each) in old for each in self.tasks)


class _Laps(Play):
    """Robots that take turns.

    `is_open` is True if at each of some lines a property were violated if nothing followed.
    """

    def __init__(self, network: Network, times: Sequence[int]) -> None:
        super().__init__(network, times, None)
        self.is_open = True
        self._watches: list[Watch] = []
        self._robot: str | None = None
        self._before = 0

    def ask(self, property_: Property, robot: str | None, before: int, lines: int) -> None:
        """Watch a property, of one robot if it is about each, at some lines after others."""
        self._watches = [watched(plan([property_]), self.data) for _ in range(lines)]
        self._robot = robot
        self._before = before

    def chosen(self, robots: Sequence[Robot]) -> Robot:
        """Return the robot that has waited for the longest time."""
        return min(robots, key=lambda robot: robot.moments[-1])

    def see(self, line: Line) -> None:
        """Ask what the verdict were if this was the last line."""
        super().see(line)
        for each in self._watches:
            each.see(line)
        if len(self.lines) > self._before and self._watches:
            (result,) = self._watches.pop(0).results(line.time, ended=True)
            is_meant = result.property.each is None or self._robot in result.robots
            self.is_open &= result.verdict == FALSE and is_meant

    def mark(self) -> _Mark:
        """Return where all robots are, and what is running."""
        places = []
        tasks: list[object] = []
        for robot in self.robots:
            channels: dict[tuple[str, str], list[int]] = {}
            for copy in sorted(robot.bag, key=lambda copy: copy.order):
                channel = (copy.topic, copy.event.envelope.sender)
                channels.setdefault(channel, []).append(copy.number)
            places.append((robot.state, channels))
            tasks += (each for _, each in robot.body.tasks())
            tasks += robot.bag
        return _Mark(tuple(places), tuple(tasks))
