"""Nodes of composition.tx: swarms, environments, fitness functions, optimizations."""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.records import dataclass
from swarmdsl.syntax.ast.architecture import Member, PartValue
from swarmdsl.syntax.ast.nodes import Documented, Node, Ref, TopLevel, Word
from swarmdsl.syntax.ast.values import Expression, FitnessInput, Param


@dataclass(slots=True, eq=False)
class Multiplicity(Node):
    """`3`, `1..5`, `2..*` or `*`, the bounds as written."""

    lower: str
    upper: str


@dataclass(slots=True, eq=False)
class Role(Documented):
    """`name : Member[multiplicity] { ... }`; `values` set params of its members."""

    name: Word
    member: Ref[Member]
    multiplicity: Multiplicity | None
    values: list[PartValue]


@dataclass(slots=True, eq=False)
class RobotValues(Documented):
    """`role[index] { ... }`: params of one robot."""

    role: Ref[Role]
    index: str
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
class Objective(Documented):
    """`maximize expression` or `minimize expression`."""

    goal: Literal["maximize", "minimize"]
    value: Expression


@dataclass(slots=True, eq=False)
class Fitness(TopLevel):
    """`fitness Name { ... }`."""

    name: Word
    items: list[FitnessInput | Param | Objective]


@dataclass(slots=True, eq=False)
class Setting(Documented):
    """`steps 1000`, `evaluations 50` or `seed 42`."""

    name: Literal["steps", "evaluations", "seed"]
    value: Expression


@dataclass(slots=True, eq=False)
class CountRange(Documented):
    """`count of role in lower .. upper`."""

    role: Ref[Role]
    lower: Expression
    upper: Expression


@dataclass(slots=True, eq=False)
class ParamRange(Documented):
    """`role.param in lower .. upper step step`."""

    role: Ref[Role]
    param: Ref[Param]
    lower: Expression
    upper: Expression
    step: Expression | None


@dataclass(slots=True, eq=False)
class Optimization(TopLevel):
    """`optimize Swarm { ... }`."""

    swarm: Ref[Swarm]
    items: list[Setting | CountRange | ParamRange]


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
    items: list[World | Size]
