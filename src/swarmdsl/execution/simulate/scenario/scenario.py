"""Scenarios: function behavior, network, messages and faults."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from random import Random
from typing import Any

from swarmdsl.base.numerals import integer
from swarmdsl.base.records import dataclass, field, replace
from swarmdsl.execution.simulate.scenario.durations import AT_ONCE, ONE_SECOND, Fixed, Length
from swarmdsl.syntax.types import SELF_FIELDS

EVERY_FUNCTION = "*"
_ENDS = frozenset(("duration", "aborted", "preempted", "never"))
"""Settings of a function that say how it ends without a model."""
_IN_ROLE = re.compile(r"(.*)\[([0-9]+)\]")


@dataclass(frozen=True)
class Robot:
    """Member of a swarm; without a name for a single machine.

    `index` is its number in its role, `count` the number of members of the role at the start.
    """

    name: str | None = None
    role: str = ""
    kind: str = ""
    index: int = 0
    count: int = 1

    @classmethod
    def called(cls, name: str) -> Robot:
        """Return the robot `uav[1]`, or one of its parts, as a node that knows its name only."""
        name = name.partition(".")[0]
        found = _IN_ROLE.fullmatch(name)
        if found is None:
            return cls(name)
        return cls(name, found[1], index=integer(found[2]), count=integer(found[2]) + 1)

    @property
    def words(self) -> tuple[str, ...]:
        """Words that select it: type of member, role and name, the most specific last."""
        return (self.kind, self.role, self.name) if self.name is not None else ()

    def is_meant_by(self, address: str | None) -> bool:
        """Return True if an event with this address is for the robot; None is for all."""
        return address is None or (address != "" and address in (self.name, self.role))

    @property
    def identity(self) -> dict[str, str | int]:
        """Return the fields of `self`."""
        values = (self.name or "", self.role, self.index, self.count)
        return dict(zip(SELF_FIELDS, values, strict=True))


@dataclass(frozen=True)
class Answer:
    """End of a call: its outcome, None if there is no answer, its result and its duration."""

    outcome: str | None
    result: Mapping[str, Any]
    duration: int


@dataclass(frozen=True)
class FunctionBehavior:
    """Behavior of a called function; the remaining probability is that of success.

    `never` is the probability of no answer. One of the `results` is returned on success.
    """

    duration: Length = ONE_SECOND
    stopping: Length = AT_ONCE
    aborted: float = 0.0
    preempted: float = 0.0
    never: float = 0.0
    results: tuple[Mapping[str, Any], ...] = ()
    model: str | None = None
    arguments: Mapping[str, Any] = field(default_factory=dict)
    """Model that the function has in a space, with its arguments."""

    def draw(self, stream: Callable[[], Random]) -> Answer:
        """Draw the end of a call; a random stream is asked for only if it is needed."""
        certain = not (self.aborted or self.preempted or self.never or len(self.results) > 1)
        if certain and isinstance(self.duration, Fixed):
            return Answer("succeeded", (self.results or ({},))[0], self.duration.length)
        chance = stream()
        outcome = self._outcome(chance.random())
        chosen = int(chance.random() * len(self.results))
        return Answer(outcome, (self.results or ({},))[chosen], self.duration.draw(chance))

    def _outcome(self, drawn: float) -> str | None:
        for outcome, share in (
            ("aborted", self.aborted),
            ("preempted", self.preempted),
            (None, self.never),
        ):
            if drawn < share:
                return outcome
            drawn -= share
        return "succeeded"


@dataclass(frozen=True)
class Message:
    """Event from outside, once or periodically; `to` selects robots.

    `sender` is the robot in whose name it comes, empty for an event from outside of the swarm.
    """

    event: str
    at: Length
    every: int | None = None
    to: tuple[str, ...] | None = None
    data: Any = None
    sender: str = ""


@dataclass(frozen=True)
class Fault:
    """Loss of a robot, of answers of a function, or of the contact between groups of robots.

    Without `lasts` it is permanent.
    """

    at: Length
    of: tuple[str, ...] | None = None
    function: str | None = None
    lasts: int | None = None
    apart: tuple[tuple[str, ...], ...] = ()

    @property
    def is_loss(self) -> bool:
        """Return True if robots are lost."""
        return self.function is None and not self.apart

    def may_keep(self, robot: Robot, time: int) -> bool:
        """Return True if a robot may be lost at a time, and comes back after it."""
        if not self.is_loss or self.lasts is None or not is_selected(robot, self.of):
            return False
        earliest, latest = self.at.bounds
        return earliest <= time <= latest + self.lasts


@dataclass(frozen=True)
class Scenario:
    """A scenario as plain data; by default, every function succeeds.

    The keys of `functions` are a function name and a word that selects robots: a type of member, a
    role, a robot, or "" for all. `params` has values by such words. `alone` is the robot that a
    machine without a swarm runs on. `world` is the kind of space, None if the model decides, and
    `step` the time between two steps of it.
    """

    seed: int = 0
    until: int | None = None
    counts: Mapping[str, int] = field(default_factory=dict)
    params: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    functions: Mapping[tuple[str, str], Mapping[str, Any]] = field(default_factory=dict)
    latency: Length = AT_ONCE
    loss: float = 0.0
    messages: tuple[Message, ...] = ()
    faults: tuple[Fault, ...] = ()
    alone: Robot = field(default_factory=Robot)
    world: str | None = None
    step: int | None = None

    def behavior(self, function: str, robot: Robot) -> FunctionBehavior:
        """Return the behavior of a robot's function; the most specific setting wins."""
        said: dict[str, Any] = {}
        for name in (EVERY_FUNCTION, function):
            for word in ("", *robot.words):
                said.update(self.functions.get((name, word), {}))
        return replace(FunctionBehavior(), **said)

    def model(self, function: str, robot: Robot) -> FunctionBehavior | None:
        """Return the most specific setting that gives a function of a robot a model.

        One without a model if it says how the function ends instead, None if nothing does.
        """
        found = None
        for word in ("", *robot.words):
            said = self.functions.get((function, word), {})
            if "model" in said or said.keys() & _ENDS:
                found = replace(FunctionBehavior(), **said)
        return found


def is_selected(robot: Robot, words: tuple[str, ...] | None) -> bool:
    """Return True if a word selects the robot; None selects all robots."""
    return words is None or any(word in words for word in robot.words)
