"""Nodes of optimization.tx: what may change to make a swarm better."""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.records import dataclass
from swarmdsl.syntax.ast.composition import Role, Swarm
from swarmdsl.syntax.ast.nodes import Documented, Ref, TopLevel
from swarmdsl.syntax.ast.properties import Property
from swarmdsl.syntax.ast.values import Expression, Param


@dataclass(slots=True, eq=False)
class Setting(Documented):
    """`steps 1000`, `evaluations 50` or `seed 42`."""

    name: Literal["steps", "evaluations", "seed"]
    value: Expression


@dataclass(slots=True, eq=False)
class SubjectTo(Documented):
    """`subject to Property`."""

    property: Ref[Property]


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
    items: list[Setting | SubjectTo | CountRange | ParamRange]
