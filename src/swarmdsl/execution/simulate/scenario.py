"""What happens around a swarm: how functions end, what is heard, what breaks."""

from __future__ import annotations

from collections.abc import Mapping
from random import Random
from typing import Any

from swarmdsl.base.records import dataclass, field, replace
from swarmdsl.execution.simulate.durations import AT_ONCE, ONE_SECOND, Length

EVERY_FUNCTION = "*"


@dataclass(frozen=True)
class Robot:
    """A member of a swarm; without a name where a machine runs alone."""

    name: str | None = None
    role: str = ""
    kind: str = ""

    @property
    def words(self) -> tuple[str, ...]:
        """What it is meant by: the type of member, the role, the name, the last one first."""
        return (self.kind, self.role, self.name) if self.name is not None else ()


@dataclass(frozen=True)
class Conduct:
    """How a function behaves when it is called; what is left of the probability is success.

    `never` is that of giving no answer. One of the `results` comes with a success.
    """

    duration: Length = ONE_SECOND
    stopping: Length = AT_ONCE
    aborted: float = 0.0
    preempted: float = 0.0
    never: float = 0.0
    results: tuple[Mapping[str, Any], ...] = ()

    def outcome(self, chance: Random) -> str | None:
        """How a call ends, None for never."""
        drawn = chance.random()
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
    """An event that comes from outside, at a time or again and again; `to` names robots."""

    event: str
    at: Length
    every: int | None = None
    to: tuple[str, ...] | None = None
    data: Any = None


@dataclass(frozen=True)
class Fault:
    """A robot that is lost, or a function of it that stops answering, for a while or for good."""

    at: Length
    of: tuple[str, ...] | None = None
    function: str | None = None
    lasts: int | None = None


@dataclass(frozen=True)
class Scenario:
    """All of it, as plain data; the default is a world in which every function succeeds.

    `functions` has what is said of a function, by its name and by whom it is said of: a type
    of member, a role, a robot, or nobody in particular (""). `params` has values by whom.
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

    def conduct(self, function: str, robot: Robot) -> Conduct:
        """How a function of a robot behaves: what is said of it most closely counts."""
        said: dict[str, Any] = {}
        for name in (EVERY_FUNCTION, function):
            for word in ("", *robot.words):
                said.update(self.functions.get((name, word), {}))
        return replace(Conduct(), **said)


def meant(robot: Robot, words: tuple[str, ...] | None) -> bool:
    """Whether a robot is one of those named; nobody in particular means all."""
    return words is None or any(word in words for word in robot.words)
