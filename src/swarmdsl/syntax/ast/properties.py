"""Nodes of properties.tx: what must be true of each run."""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.records import dataclass, field
from swarmdsl.syntax.ast.behaviour import StateMachine
from swarmdsl.syntax.ast.composition import Claim, Each, Swarm, Term
from swarmdsl.syntax.ast.nodes import Node, Ref, TopLevel, Word
from swarmdsl.syntax.ast.values import Expression

PropertySubject = Swarm | StateMachine


@dataclass(slots=True, eq=False)
class PropertyScope(Node):
    """`after P,`, `after P until Q,`, `before P,` or `between P and Q,`; `kind` is one word."""

    kind: str
    start: Claim | None
    end: Claim | None
    first: Term | None
    last: Term | None


@dataclass(slots=True, eq=False)
class Pattern(Node):
    """`never P`, `P leads to Q within T` and so on; `kind` is the first word of the pattern."""

    kind: str
    claim: Claim
    times: str
    other: Claim | None
    later: list[Claim]
    within: Expression | None


@dataclass(slots=True, eq=False)
class Chance(Node):
    """`at least 0.95`, the probability as written."""

    bound: Literal["least", "most"]
    probability: str


@dataclass(slots=True, eq=False)
class Property(TopLevel):
    """`property Name of Swarm : ...`; only the linker sets what it is `about`."""

    name: Word
    subject: Ref[PropertySubject] | None
    each: Each | None
    scope: PropertyScope | None
    body: Pattern
    chance: Chance | None
    about: PropertySubject | None = field(default=None, init=False, metadata={"elsewhere": True})
