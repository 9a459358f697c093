"""Facts of properties in a run: which robots are in a state, have values or do something."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from typing import Any, Protocol

from .claims import Count, Fact

LOST = "fault.lost"
"""Event of a lost robot; no model event has such a name."""
MOMENTARY = frozenset(("sends", "hears", "starts", "cancels", "ends", "arrives"))
"""Acts that happen at one step, in contrast to states and values."""
OUTCOMES = ("succeeded", "aborted", "preempted")


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

    @property
    def functions(self) -> Iterable[tuple[str, str]]:
        """Paths of states with the functions that they call."""


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


class Facts:
    """Facts that sentences about a run use: each is a bit in a number.

    `momentary` has the bits of those that happen at one step.
    """

    def __init__(self) -> None:
        self.momentary = 0
        self._bits: dict[tuple[str, str, str | None, Hashable, str], int] = {}

    def bit(self, fact: Fact | Count, role: str | None) -> int:
        """Return the bit of a fact of a role, or of all roles."""
        key: tuple[str, str, str | None, Hashable, str]
        if isinstance(fact, Count):
            key = ("in", fact.state, role, None, "")
        else:
            key = (fact.act, fact.name, role, fact.condition, fact.outcome)
        bit = self._bits.setdefault(key, 1 << len(self._bits))
        if key[0] in MOMENTARY:
            self.momentary |= bit
        return bit

    def kind_of(self, actor: ActorLike) -> Kind:
        """Return the facts that lines of an actor can change."""
        return Kind(
            [
                (bit, Fact(act, name, condition=condition, outcome=outcome))
                for (act, name, role, condition, outcome), bit in self._bits.items()
                if role in (None, actor.robot.role) and can_hold(act, actor)
            ],
            actor.states,
            actor.functions,
        )


class Kind:
    """Facts that the lines of machines of one kind can change, in `mask`.

    `acts` are the bits of what machines do and hear, by act and name, `values` those of what
    robots have, and `conditional` those of all facts with a condition.
    `places` are the facts that hold in known configurations, `from_outside` and `from_robots`
    those about the events of a robot and about values. `functions` are called by states.
    """

    def __init__(
        self,
        facts: Iterable[tuple[int, Fact]],
        states: Sequence[str],
        functions: Iterable[tuple[str, str]],
    ) -> None:
        self.mask = self.values = self.conditional = 0
        self._conditions: list[tuple[int, Fact]] = []
        self.acts: dict[str, dict[str, int]] = {act: {} for act in MOMENTARY}
        self._states: list[tuple[int, set[str]]] = []
        heard: dict[str | None, int] = {}
        self.places: dict[Hashable, int] = {}
        for bit, fact in facts:
            self.mask |= bit
            if fact.condition is not None:
                self.conditional |= bit
                self._conditions.append((bit, fact))
            if fact.act == "in":
                self._states.append((bit, meant_states(states, fact.name.split("."))))
            elif fact.act == "has":
                self.values |= bit
            elif fact.act == "ends":
                for event in _ends(fact, functions):
                    heard[event] = heard.get(event, 0) | bit
            else:
                acts = self.acts[fact.act]
                acts[fact.name] = acts.get(fact.name, 0) | bit
        # The end of an activity is an event of its own.
        heard.update(self.acts["hears"])
        arrives: Mapping[str | None, int] = dict(self.acts["arrives"].items())
        self._hears, self._arrives = heard, arrives
        self.from_outside: dict[str | None, int] = {}
        self.from_robots: dict[str | None, int] = {}
        for each in (*heard, *arrives):
            self.from_robots[each] = heard.get(each, 0) | self.values
            self.from_outside[each] = self.from_robots[each] | arrives.get(each, 0)

    def holding(self, line: LineLike, has: Has) -> int:
        """Return the facts that hold for the machine of a line, after it."""
        found, acts = self.inside(line.configuration), self.acts
        for act, names in (
            ("sends", line.sent),
            ("starts", line.started),
            ("cancels", line.cancelled),
        ):
            for name in names:
                found |= acts[act].get(name, 0)
        return self.complete(line, has, found)

    def inside(self, configuration: Sequence[str]) -> int:
        """Return the facts that hold in a configuration, given by its innermost states."""
        key = tuple(configuration)
        found = self.places.get(key)
        if found is None:
            active = {each for leaf in key for each in _around(leaf)}
            found = sum(bit for bit, meant in self._states if not active.isdisjoint(meant))
            self.places[key] = found
        return found

    def complete(self, line: LineLike, has: Has, found: int) -> int:
        """Add the facts about the event of a line and about values, and look at all conditions.

        After a loss no fact holds.
        """
        event = line.event
        if event == LOST:
            return 0
        found |= self.arriving(event, line.envelope.sender, line.deferred, line.recalled)
        return self.under_conditions(line, has, found) if found & self.conditional else found

    def arriving(self, event: str | None, sender: str, deferred: bool, recalled: bool) -> int:
        """Return the facts about an event and about values, with conditions or without them."""
        found = self.values
        # A deferred event arrives once, and is heard once.
        if not deferred:
            found |= self._hears.get(event, 0)
        if not (recalled or sender):
            found |= self._arrives.get(event, 0)
        return found

    def under_conditions(self, line: LineLike, has: Has, found: int) -> int:
        """Leave out the facts whose conditions do not hold."""
        for bit, fact in self._conditions:
            if found & bit and not has(line, fact):
                found ^= bit
        return found


def can_hold(act: str, actor: ActorLike) -> bool:
    """Return True if an act can be that of a machine: values are those of the robot itself."""
    return act != "has" or actor.name == actor.robot.name


def _ends(fact: Fact, functions: Iterable[tuple[str, str]]) -> Iterator[str]:
    """Yield the events by which a function ends as a fact says, for each state that calls it."""
    for state, function in functions:
        if function == fact.name:
            for outcome in OUTCOMES:
                if fact.outcome in ("", outcome):
                    yield f"do.{state}.{outcome}"


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
