"""Facts of properties in a run: which robots are in a state, have values or do something."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from swarmdsl.execution.engine import ExecutionError, Machine
from swarmdsl.execution.simulate.actors import Actor
from swarmdsl.execution.simulate.expressions import function_of
from swarmdsl.execution.simulate.trace import Line
from swarmdsl.execution.simulate.world import LOST
from swarmdsl.ir import Count, Expression, Fact

Data = Callable[[Actor], Mapping[str, Any]]
MOMENTARY = frozenset(("sends", "hears", "starts", "cancels", "arrives"))
"""What happens at one step, in contrast to what is."""


class FactTracker:
    """Robots of a role for which a fact holds; None stands for a machine without a swarm.

    `holding` are the robots for which it holds now, `robots` those that are not lost.
    """

    def __init__(self, fact: Fact | Count, cast: Sequence[Actor], data: Data) -> None:
        self.act = "in" if isinstance(fact, Count) else fact.act
        self.name = fact.state if isinstance(fact, Count) else fact.name
        self.momentary = self.act in MOMENTARY
        self.robots = {actor.robot.name for actor in cast}
        self.holding: set[str | None] = set()
        self._true: set[Actor] = set()
        guard = fact.guard if isinstance(fact, Fact) else None
        if guard is not None:
            # Values are those of the robot itself, not of its parts.
            self._cast = frozenset(actor for actor in cast if actor.name == actor.robot.name)
            self._holds = _has(guard, data)
        else:
            self._cast = frozenset(cast)
            self._holds = _in(self.name) if self.act == "in" else _ACTS[self.act](self.name)

    def follows(self, actor: Actor) -> bool:
        """Return True if lines of an actor can change the fact."""
        return actor in self._cast

    def see(self, line: Line) -> bool:
        """Process a line of an actor that it follows; return True if the fact changes."""
        actor, robot = line.actor, line.actor.robot.name
        if line.event == LOST:
            known = robot in self.robots
            self.robots.discard(robot)
            self._set(actor, robot, value=False)
            return known
        return self._set(actor, robot, value=self._holds(line))

    def reset(self) -> set[str | None]:
        """Forget what happened; return the robots to which it did."""
        happened, self.holding = self.holding, set()
        self._true.clear()
        return happened

    def _set(self, actor: Actor, robot: str | None, *, value: bool) -> bool:
        if value == (actor in self._true):
            return False
        if value:
            self._true.add(actor)
        else:
            self._true.remove(actor)
        held = robot in self.holding
        holds = value or any(other.robot.name == robot for other in self._true)
        if holds:
            self.holding.add(robot)
        else:
            self.holding.discard(robot)
        return held != holds


def _has(guard: Expression, data: Data) -> Callable[[Line], bool]:
    value = function_of(guard)

    def holds(line: Line) -> bool:
        try:
            return bool(value(data(line.actor), None))
        except (ArithmeticError, ValueError, ExecutionError):
            return False

    return holds


def _in(name: str) -> Callable[[Line], bool]:
    known: dict[tuple[Machine, tuple[str, ...]], bool] = {}
    written = name.split(".")

    def holds(line: Line) -> bool:
        key = (line.actor.machine, tuple(line.configuration))
        if key not in known:
            known[key] = _is_in(*key, written)
        return known[key]

    return holds


def _is_in(machine: Machine, innermost: Iterable[str], written: Sequence[str]) -> bool:
    places = [machine.numbers[state] for state in innermost]
    around = {each for place in places for each in (place, *machine.ancestors(place))}
    meant = meant_states(machine, written)
    return any(machine.states[each].id in meant for each in around)


def meant_states(machine: Machine, written: Sequence[str]) -> set[str]:
    """Return the ids of the states that a name or a path means in a machine."""
    ids = [state.id for state in machine.states[1:]]
    return {".".join(written)} & {*ids} or {each for each in ids if _matches(each, written)}


def _matches(state: str, written: Sequence[str]) -> bool:
    *outer, last = state.split(".")
    names = iter(outer)
    return last == written[-1] and all(name in names for name in written[:-1])


_ACTS: Mapping[str, Callable[[str], Callable[[Line], bool]]] = {
    "sends": lambda name: lambda line: name in line.sent,
    "starts": lambda name: lambda line: name in line.started,
    "cancels": lambda name: lambda line: name in line.cancelled,
    "hears": lambda name: lambda line: line.event == name,
    "arrives": lambda name: lambda line: line.event == name and not line.envelope.sender,
}


class Route:
    """Trackers that follow one actor, by the lines that can change them."""

    def __init__(self, trackers: Sequence[FactTracker]) -> None:
        self._all = trackers
        self._states = [each for each in trackers if each.act == "in"]
        self._values = [each for each in trackers if each.act == "has"]
        self._named: dict[tuple[str, str], list[FactTracker]] = {}
        for each in trackers:
            if each.momentary:
                act = "hears" if each.act == "arrives" else each.act
                self._named.setdefault((act, each.name), []).append(each)
        self._last: list[str] | None = None

    def trackers_of(self, line: Line) -> Sequence[FactTracker]:
        """Return the trackers that a line can change."""
        if line.event == LOST:
            return self._all
        found = list(self._values)
        if line.configuration != self._last:
            self._last = list(line.configuration)
            found += self._states
        named = self._named
        if named:
            if line.event is not None:
                found += named.get(("hears", line.event), ())
            for act, names in (
                ("sends", line.sent),
                ("starts", line.started),
                ("cancels", line.cancelled),
            ):
                for name in names:
                    found += named.get((act, name), ())
        return found
