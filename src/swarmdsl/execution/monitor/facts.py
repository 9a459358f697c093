"""Facts of properties in a run: which robots are in a state, have values or do something."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from typing import Any, Protocol

from .claims import Count, Fact

LOST = "fault.lost"
"""Event of a lost robot; no model event has such a name."""
MOMENTARY = frozenset(("sends", "hears", "starts", "cancels", "arrives"))
"""Acts that happen at one step, in contrast to states and values."""
ACTS = MOMENTARY | {"in", "has"}


class RobotLike(Protocol):
    """Robot with its name, None if it is alone, and its role in the swarm."""

    @property
    def name(self) -> str | None:
        """Name of the robot."""

    @property
    def role(self) -> str:
        """Name of its role."""


class ActorLike(Hashable, Protocol):
    """Machine of a robot, or of a part of it that has a name of its own."""

    @property
    def name(self) -> str | None:
        """Name of the robot, followed by a dot and the name of the part."""

    @property
    def robot(self) -> RobotLike:
        """Robot that runs the machine."""

    @property
    def states(self) -> Sequence[str]:
        """Paths of all states of the machine."""


class LineLike(Protocol):
    """Step of a machine, as in a trace; states are given by their paths."""

    @property
    def time(self) -> int:
        """Time since the beginning of the run, in nanoseconds."""

    @property
    def actor(self) -> ActorLike:
        """Machine that takes the step."""

    @property
    def event(self) -> str | None:
        """Event that it processes, None for its start."""

    @property
    def envelope(self) -> Any:
        """Envelope of the event, with the name of the `sender`."""

    @property
    def deferred(self) -> bool:
        """Return True if the event is kept for later."""

    @property
    def recalled(self) -> bool:
        """Return True if the event has been kept before."""

    @property
    def configuration(self) -> Sequence[str]:
        """Innermost active states after it."""

    @property
    def started(self) -> Sequence[str]:
        """Functions that it calls."""

    @property
    def cancelled(self) -> Sequence[str]:
        """Functions whose calls it cancels."""

    @property
    def sent(self) -> Sequence[str]:
        """Events that it sends."""


Has = Callable[[Any, Fact], bool]
"""Truth of the condition of a fact for the robot of a line, after the line; that of a fact that an
event happens is about a message of the line."""
Test = Callable[[LineLike], bool]


class FactTracker:
    """Robots of a role, or of all roles, for which a fact holds.

    `holding` are the robots for which it holds now, `robots` those that are there: they have
    started and are not lost. None stands for a machine without a swarm.
    """

    def __init__(self, fact: Fact | Count, role: str | None, has: Has) -> None:
        self.act = "in" if isinstance(fact, Count) else fact.act
        self.name = fact.state if isinstance(fact, Count) else fact.name
        self.momentary = self.act in MOMENTARY
        self.robots: set[str | None] = set()
        self.holding: set[str | None] = set()
        self._role = role
        self._true: set[ActorLike] = set()
        self._holds = test_of(fact, has)

    def follows(self, actor: ActorLike) -> bool:
        """Return True if lines of an actor can change the fact."""
        return self._role in (None, actor.robot.role) and can_hold(self.act, actor)

    def see(self, line: LineLike) -> bool:
        """Process a line of an actor that it follows; return True if the fact changes."""
        actor, robot = line.actor, line.actor.robot.name
        if line.event == LOST:
            known = robot in self.robots
            self.robots.discard(robot)
            self._set(actor, robot, value=False)
            return known
        changed = self._set(actor, robot, value=self._holds(line))
        if robot not in self.robots:
            self.robots.add(robot)
            return True
        return changed

    def reset(self) -> set[str | None]:
        """Forget what happened; return the robots to which it did."""
        happened, self.holding = self.holding, set()
        self._true.clear()
        return happened

    def _set(self, actor: ActorLike, robot: str | None, *, value: bool) -> bool:
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


def can_hold(act: str, actor: ActorLike) -> bool:
    """Return True if an act can be that of a machine: values are those of the robot itself."""
    return act != "has" or actor.name == actor.robot.name


def test_of(fact: Fact | Count, has: Has) -> Test:
    """Return the function that says if a fact holds for the machine of a line, after it."""
    if isinstance(fact, Count):
        return _in(fact.state)
    if fact.act == "has":
        return lambda line: has(line, fact)
    if fact.act == "in":
        return _in(fact.name)
    happens = _ACTS[fact.act](fact.name)
    if fact.condition is None:
        return happens
    return lambda line: happens(line) and has(line, fact)


def _in(name: str) -> Test:
    known: dict[tuple[ActorLike, tuple[str, ...]], bool] = {}
    meant: dict[ActorLike, set[str]] = {}
    written = name.split(".")

    def holds(line: LineLike) -> bool:
        actor = line.actor
        key = (actor, tuple(line.configuration))
        if key not in known:
            if actor not in meant:
                meant[actor] = meant_states(actor.states, written)
            known[key] = any(each in meant[actor] for leaf in key[1] for each in _around(leaf))
        return known[key]

    return holds


def _around(state: str) -> list[str]:
    """Return the path of a state, and those of the states around it."""
    names = state.split(".")
    return [".".join(names[:end]) for end in range(1, len(names) + 1)]


def meant_states(states: Sequence[str], written: Sequence[str]) -> set[str]:
    """Return the paths of the states that a name or a path means in a machine."""
    return {".".join(written)} & {*states} or {each for each in states if _matches(each, written)}


def _matches(state: str, written: Sequence[str]) -> bool:
    *outer, last = state.split(".")
    names = iter(outer)
    return last == written[-1] and all(name in names for name in written[:-1])


_ACTS: dict[str, Callable[[str], Test]] = {
    "sends": lambda name: lambda line: name in line.sent,
    "starts": lambda name: lambda line: name in line.started,
    "cancels": lambda name: lambda line: name in line.cancelled,
    # A deferred event arrives once, and is heard once.
    "hears": lambda name: lambda line: line.event == name and not line.deferred,
    "arrives": lambda name: (
        lambda line: line.event == name and not line.recalled and not line.envelope.sender
    ),
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
        self._last: Sequence[str] | None = None

    def trackers_of(self, line: LineLike) -> Sequence[FactTracker]:
        """Return the trackers that a line can change: all if the robot comes or is lost."""
        if self._last is None or line.event == LOST:
            self._last = None if line.event == LOST else list(line.configuration)
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
