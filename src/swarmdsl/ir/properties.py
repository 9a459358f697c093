"""Properties: what must be true of each run; measures: what is measured in it."""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.ir.architecture import Multiplicity
from swarmdsl.ir.expressions import Expression

Act = Literal["in", "has", "sends", "hears", "starts", "cancels", "ends", "arrives"]
Kind = Literal[
    "never", "always", "eventually", "possible", "again", "leads", "only", "times", "then"
]
"""Pattern: `never P`, `P at all times`, `eventually P`, `always possible P`, `again and again P`,
`P leads to Q`, `P only after Q`, `P at most N times`, `P then Q`; `P within T` is eventually."""


@dataclass(frozen=True, slots=True)
class Robots:
    """Robots of a role: all, some, no, another one, a number of them, or one by its index."""

    role: str
    quantifier: Literal["all", "some", "no", "number", "index"]
    number: Multiplicity | None = None
    index: int | None = None
    other: bool = False


@dataclass(frozen=True, slots=True)
class Fact:
    """State or act of robots: the name is that of a state, an event or a function.

    Without `robots`, the fact is about the robot of `each` or the only machine; an event that
    `arrives` comes from outside. The `guard` of an event is about its message; of one that is
    sent, it is evaluated with the variables after the step. A function `ends` in any way, or with
    the `outcome` succeeded, aborted or preempted.
    """

    act: Act
    name: str = ""
    robots: Robots | None = None
    guard: Expression | None = None
    outcome: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Count:
    """Comparison of the number of robots of a role in a state."""

    role: str
    state: str
    comparison: Literal["==", "!=", "<=", ">=", "<", ">"]
    number: int
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Junction:
    """Claims joined by `and` or `or`, or one claim that is negated by `not`."""

    operator: Literal["and", "or", "not"]
    claims: tuple[Claim, ...]


Claim = Fact | Count | Junction


@dataclass(frozen=True, slots=True)
class Scope:
    """Part of a run: after or before a claim, or between two, or after one until another."""

    kind: Literal["after", "before", "between", "until"]
    claims: tuple[Claim, ...]


@dataclass(frozen=True, slots=True)
class Chance:
    """Probability with which a property must hold."""

    bound: Literal["least", "most"]
    probability: float


@dataclass(frozen=True, slots=True)
class Property:
    """Sentence about each run of a swarm or a machine, or about each robot of a role.

    `times` is the limit of kind `times`.
    """

    name: str
    subject: str
    kind: Kind
    claims: tuple[Claim, ...]
    each: str | None = None
    scope: Scope | None = None
    within: Expression | None = None
    times: int | None = None
    chance: Chance | None = None
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Measure:
    """Number of robots, how often something happens, how long it lasts, or the time until it.

    A fact about a role without a number is about each of its robots, all of them together.
    `over` is the mean, least or greatest number in the run instead of that in the end; with an
    `aggregate`, the sum, mean, least or greatest value of the robots of role `each`.
    """

    kind: Literal["count", "total", "time", "until"]
    claim: Claim
    over: Literal["mean", "min", "max"] | None = None
    aggregate: Literal["sum", "mean", "min", "max"] | None = None
    each: str | None = None

    @property
    def counted_role(self) -> str | None:
        """Role whose robots are counted, if the claim is a fact about one without a number."""
        robots = self.claim.robots if isinstance(self.claim, Fact) else None
        if self.kind == "until" or robots is None:
            return None
        is_role = robots.quantifier == "index" and robots.index is None
        return robots.role if is_role else None
