"""Verdicts on what must happen in small swarms, by all fair loops; slow.

As in `slow`, nothing is shared with the verifier: each robot is looked at by itself, and each state
is reached by playing a whole run again.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.monitor import FALSE
from swarmdsl.execution.simulate.evaluation.properties import watchable
from swarmdsl.execution.simulate.machines.actors import actors
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.scenario import Scenario
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.ir import System

from .slow import Choice, Swarm

LIVE = ("eventually", "leads", "then", "again")
Open = frozenset[tuple[str, str | None]]
"""Properties, and robots, for which something must still happen."""


class _Watched(Swarm):
    """A swarm that notes at each line for whom something must still happen."""

    def __init__(self, *arguments: Any, silent: bool) -> None:
        self.open: list[Open] = []
        self._silent = silent
        self._built = False
        super().__init__(*arguments)
        self._built = True
        if not any(self.watch._begun for _ in (0,)):
            self.watch._begin()
        self.open.append(self.now_open())

    def _see(self, line: Line) -> None:
        super()._see(line)
        if self._built:
            self.open.append(self.now_open())

    def now_open(self) -> Open:
        return frozenset(
            (watched.rule.property.name, robot)
            for watched in self.watch._watched
            for robot, state in watched.states.items()
            if robot not in self.lost or robot is None
            if not state.is_violated and state.monitor.copy().finish(0, ended=True) == FALSE
        )

    def running(self) -> list[tuple[Any, object]]:
        """What is over some time, and the objects that stand for it."""
        number = {id(each): n for n, each in enumerate(self.instances)}
        found: list[tuple[Any, object]] = [
            (("run", number[id(run.instance)], run.state), run)
            for run in self.runs
            if not self._silent
        ]
        for delay in self.delays:
            timer = delay.__self__
            found.append((("delay", number[id(timer.instance)], timer.event.name), delay))
        for n, bag in enumerate(self.bags):
            found += [(("message", n, *map(repr, each[:2])), each) for each in bag]
        return found

    @property
    def known(self) -> str:
        """All that decides on what can happen, on the monitors and on what is over next."""
        moments = sorted((str(each.name), bits) for each, bits in self.watch.happened.items())
        return repr((self.key, moments))


class _Edge(NamedTuple):
    target: int
    over: frozenset[Any]
    open: Open


class _Node(NamedTuple):
    running: frozenset[Any]
    open: Open
    edges: list[_Edge]


def never_happening(
    system: System,
    outside: Sequence[str],
    capacity: int,
    most: int,
    *,
    lossy: bool = False,
    faults: int = 0,
    silent: bool = False,
) -> set[str] | None:
    """Return the properties that a fair run for ever violates; None with more than `most` states.

    Those that a finite run violates may be among them or not. With `silent`, functions may never
    answer.
    """
    swarm = system.swarms[0]
    subject = Subject(swarm.name, system, swarm)
    cast = actors(subject, subject.create_robots({}), Scenario(), Diagnostics())
    about = [
        each
        for each in watchable(subject)
        if each.kind in LIVE
        and (each.scope is None or each.scope.kind not in ("before", "between"))
    ]

    def play(path: Sequence[Choice]) -> _Watched:
        played = _Watched(cast, about, system, capacity, silent=silent)
        for choice in path:
            played.take(choice)
        return played

    numbers = {play(()).known: 0}
    nodes: list[_Node] = []
    queue: deque[tuple[Choice, ...]] = deque([()])
    while queue:
        path = queue.popleft()
        now = play(path)
        node = _Node(frozenset(key for key, _ in now.running()), now.now_open(), [])
        nodes.append(node)
        choices = list(now.choices(outside))
        if lossy:
            choices += [("drop", n, m) for n, bag in enumerate(now.bags) for m in range(len(bag))]
        for choice in (*choices, *now.losses(faults)):
            after = play(path)
            before = after.running()
            lines = len(after.open)
            after.take(choice)
            left = {id(each) for _, each in after.running()}
            over = frozenset(key for key, each in before if id(each) not in left)
            stays = frozenset.intersection(node.open, after.now_open(), *after.open[lines:])
            if after.known not in numbers:
                numbers[after.known] = len(numbers)
                queue.append((*path, choice))
                if len(numbers) > most:
                    return None
            node.edges.append(_Edge(numbers[after.known], over, stays))
    every = {each for node in nodes for each in node.open}
    return {name for name, robot in every if _has_fair_loop(nodes, (name, robot))}


def _has_fair_loop(nodes: Sequence[_Node], about: tuple[str, str | None]) -> bool:
    """Return True if something may never happen, though all that is running is over some time."""
    inside = [n for n, node in enumerate(nodes) if about in node.open]
    if any(not nodes[n].running for n in inside):
        return True
    reached = {n: set(_reached(nodes, n, about)) for n in inside}
    for first in inside:
        loop = [n for n in reached[first] if first in reached[n]]
        if not loop:
            continue
        running = frozenset.intersection(*(nodes[n].running for n in loop))
        for n in loop:
            for edge in nodes[n].edges:
                if about in edge.open and edge.target in loop:
                    running -= edge.over
        if not running:
            return True
    return False


def _reached(nodes: Sequence[_Node], first: int, about: tuple[str, str | None]) -> Iterator[int]:
    """Yield the nodes at the ends of all ways on which something does not happen."""
    found: set[int] = set()
    todo = [first]
    while todo:
        for edge in nodes[todo.pop()].edges:
            if about in edge.open and edge.target not in found:
                found.add(edge.target)
                todo.append(edge.target)
    yield from found
