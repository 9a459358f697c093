"""Nodes of properties.tx: what must be true of each run."""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.records import dataclass, field
from swarmdsl.syntax.ast.behaviour import StateMachine, Vertex
from swarmdsl.syntax.ast.composition import Role, Swarm
from swarmdsl.syntax.ast.interfaces import Event, Function
from swarmdsl.syntax.ast.nodes import Node, Ref, TopLevel, Word
from swarmdsl.syntax.ast.values import Expression

PropertySubject = Swarm | StateMachine


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

    `act` and `comparison` are as written, or empty.
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
class Each(Node):
    """`each role :`."""

    role: Ref[Role]


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


_MOST_DIGITS = 9


def whole(digits: str) -> int:
    """Return a number as written; one that is larger than any swarm is as good as another."""
    significant = digits.lstrip("0")
    return int(significant or "0") if len(significant) <= _MOST_DIGITS else 10**_MOST_DIGITS
