"""Nodes of composition.tx: swarms, environments, fitness, and facts."""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.records import dataclass, field
from swarmdsl.syntax.ast.architecture import Member
from swarmdsl.syntax.ast.behaviour import StateMachine, Vertex
from swarmdsl.syntax.ast.interfaces import Event, Function
from swarmdsl.syntax.ast.nodes import Documented, Node, Ref, TopLevel, Word
from swarmdsl.syntax.ast.space import Area, Obstacle, Rain, Start, Targets, Wall, Wind, Zone
from swarmdsl.syntax.ast.values import Expression, Input, Param, PartValue


@dataclass(slots=True, eq=False)
class Multiplicity(Node):
    """`3`, `1..5`, `2..*` or `*`, the bounds as written."""

    lower: str
    upper: str


@dataclass(slots=True, eq=False)
class Role(Documented):
    """`name : Member[multiplicity] in area { ... }`; `values` set params of its members."""

    name: Word
    member: Ref[Member]
    multiplicity: Multiplicity | None
    start: Start | None
    values: list[PartValue]


@dataclass(slots=True, eq=False)
class RobotValues(Documented):
    """`role[index] at (x, y) { ... }`: start and params of one robot."""

    role: Ref[Role]
    index: str
    start: Start | None
    values: list[PartValue]


@dataclass(slots=True, eq=False)
class EnvironmentUse(Documented):
    """`environment Name` in a swarm."""

    environment: Ref[Environment]


@dataclass(slots=True, eq=False)
class Swarm(TopLevel):
    """`swarm Name { ... }`."""

    name: Word
    items: list[EnvironmentUse | FitnessUse | Heartbeat | Role | RobotValues]


@dataclass(slots=True, eq=False)
class Heartbeat(Documented):
    """`heartbeat period lost after timeout` in a swarm."""

    period: Expression
    timeout: Expression


@dataclass(slots=True, eq=False)
class FitnessUse(Documented):
    """`fitness Name` in a swarm."""

    fitness: Ref[Fitness]


@dataclass(slots=True, eq=False)
class Who(Node):
    """`some other role`, `2..3 role`, `role[1]`, `role`; numbers as written, or empty."""

    quantifier: str
    other: bool
    lower: str
    upper: str
    role: Ref[Role]
    index: str


@dataclass(slots=True, eq=False)
class Fact(Node):
    """`who in State`, `who sends Event`, `count(role in State) > 1`, or an event from outside.

    `act`, `outcome` and `comparison` are as written, or empty. The `guard` of an event is about its
    message.
    """

    counted: Ref[Role] | None
    state: Ref[Vertex] | None
    comparison: str
    number: str
    who: Who | None
    guard: Expression | None
    act: str
    event: Ref[Event] | None
    function: Ref[Function] | None
    outcome: str


@dataclass(slots=True, eq=False)
class Term(Node):
    """A fact or a claim in parentheses, perhaps after `not`."""

    negated: bool
    claim: Claim | None
    fact: Fact | None


@dataclass(slots=True, eq=False)
class Conjunction(Node):
    """Terms joined by `and`."""

    all: list[Term]


@dataclass(slots=True, eq=False)
class Claim(Node):
    """Conjunctions joined by `or`."""

    any: list[Conjunction]


@dataclass(slots=True, eq=False)
class Each(Node):
    """`each role :`."""

    role: Ref[Role]


@dataclass(slots=True, eq=False)
class Measure(Node):
    """`mean each role : time(in State)`, `max count(role in State)`, `time until all role ...`.

    Words that are not there are empty; only the linker sets what it is `about`.
    """

    aggregate: str
    each: Each | None
    kind: Literal["count", "total", "time"]
    claim: Claim
    until: str
    over: str
    about: Swarm | StateMachine | None = field(
        default=None, init=False, metadata={"elsewhere": True}
    )


@dataclass(slots=True, eq=False)
class SpaceMeasure(Node):
    """`distance(role)`, `energy(role)`, `covered(role)` or `found(target)`."""

    quantity: Literal["distance", "energy", "covered", "found"]
    role: Ref[Role] | None
    target: Ref[Targets] | None


@dataclass(slots=True, eq=False)
class FitnessInput(Input):
    """`in name : Type = measure`, measured in a run, or in a space."""

    space: SpaceMeasure | None
    measure: Measure | None


@dataclass(slots=True, eq=False)
class Objective(Documented):
    """`maximize expression` or `minimize expression`."""

    goal: Literal["maximize", "minimize"]
    value: Expression


@dataclass(slots=True, eq=False)
class Fitness(TopLevel):
    """`fitness Name of Swarm { ... }`; only the linker sets what it is `about`."""

    name: Word
    subject: Ref[Swarm] | None
    items: list[FitnessInput | Param | Objective]
    about: Swarm | None = field(default=None, init=False, metadata={"elsewhere": True})


@dataclass(slots=True, eq=False)
class World(Documented):
    """`world "file"`."""

    file: Word


@dataclass(slots=True, eq=False)
class Size(Documented):
    """`size 100 m x 100 m`, the lengths as written."""

    width: str
    depth: str
    height: str


_METRES = {"mm": 0.001, "cm": 0.01, "km": 1000.0, "m": 1.0}


def in_metres(length: str) -> float:
    """Return a length as written, `10 m` for instance, in metres."""
    unit = next(unit for unit in _METRES if length.endswith(unit))
    return float(length.removesuffix(unit)) * _METRES[unit]


@dataclass(slots=True, eq=False)
class Environment(TopLevel):
    """`environment Name { ... }`."""

    name: Word
    items: list[World | Size | Area | Zone | Wall | Obstacle | Targets | Wind | Rain]


_MOST_DIGITS = 9


def whole(digits: str) -> int:
    """Return a number as written; one that is larger than any swarm is as good as another."""
    significant = digits.lstrip("0")
    return int(significant or "0") if len(significant) <= _MOST_DIGITS else 10**_MOST_DIGITS
