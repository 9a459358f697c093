"""Properties and measures as plain data: sentences and numbers about states and acts of robots."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any, NamedTuple

from .monitor import Sentence


class Robots(NamedTuple):
    """Robots of a role, selected by a quantifier.

    It is `all`, `some` or `no`, `index` for that with a number, or `number` for `least` to `most`.
    `other` leaves out the robot that the sentence is about. In a measure, `every` stands for a
    fact about each of them.
    """

    role: str
    quantifier: str
    least: int = 0
    most: int | None = None
    number: int = 0
    other: bool = False


class Fact(NamedTuple):
    """Act of robots: `in`, `has`, `sends`, `hears`, `starts`, `cancels`, `ends` or `arrives`.

    The name is that of a state, an event or a function; `condition` is what robots have, or what
    the message of an event is like, `outcome` how a function ends. Without `robots`, the fact is
    about the robot of `each` or the only machine.
    """

    act: str
    name: str = ""
    robots: Robots | None = None
    condition: Hashable = None
    outcome: str = ""


class Count(NamedTuple):
    """Comparison of the number of robots of a role in a state."""

    role: str
    state: str
    comparison: str
    number: int


class Junction(NamedTuple):
    """Claims joined by `and` or `or`, or one claim that is negated by `not`."""

    operator: str
    claims: tuple[Claim, ...]


Claim = Fact | Count | Junction


class Property(NamedTuple):
    """Sentence about each run, or about each robot of the role `each`.

    `scope` has the claims of the scope. A property with a `chance` is not refuted by one run;
    `origin` is its place in the model.
    """

    name: str
    sentence: Sentence
    claims: tuple[Claim, ...]
    scope: tuple[Claim, ...] = ()
    each: str | None = None
    chance: Any = None
    origin: Any = None


class Measure(NamedTuple):
    """Number of robots, how often something happens, how long it lasts, or the time until it.

    `kind` is `count`, `total`, `time` or `until`. `over` is `mean`, `min` or `max` of a number in
    the run; `aggregate` is `sum`, `mean`, `min` or `max` of the robots of the role `each`.
    """

    name: str
    kind: str
    claim: Claim
    over: str | None = None
    aggregate: str | None = None
    each: str | None = None


def facts_in(claim: Claim) -> list[Fact | Count]:
    """Return the facts in a claim, in order."""
    if isinstance(claim, Junction):
        return [fact for inner in claim.claims for fact in facts_in(inner)]
    return [claim]
