"""Properties and measures as sentences of the language: texts, names and expressions."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.records import dataclass
from swarmdsl.ir.expressions import Expression
from swarmdsl.ir.properties import Claim, Count, Fact, Junction, Measure, Property, Robots


@dataclass(frozen=True, slots=True)
class Named:
    """Name of an event, a function, a swarm or the like in a sentence.

    A state is one of the robots of a role; without one, of the robot of `each` or the machine.
    """

    kind: str
    name: str
    role: str | None = None


@dataclass(frozen=True, slots=True)
class Condition:
    """Condition on the values of such robots, or on a message."""

    expression: Expression
    role: str | None


Part = str | Named | Condition | Expression
_EVENTS = ("sends", "hears", "arrives")


def head(property_: Property) -> Iterator[Part]:
    """Yield the parts before the colon: `property Name of Swarm`."""
    yield f"property {property_.name} of "
    yield Named("subject", property_.subject)


def sentence(property_: Property) -> Iterator[Part]:
    """Yield the parts after the colon: `each robot : after P, Q leads to R within 5 s`."""
    if property_.each is not None:
        yield f"each {property_.each} : "
    scope = property_.scope
    if scope is not None:
        first, *others = scope.claims
        yield "after " if scope.kind == "until" else f"{scope.kind} "
        yield from _term(first) if scope.kind == "between" else claim(first)
        for other in others:
            yield " and " if scope.kind == "between" else " until "
            yield from _term(other) if scope.kind == "between" else claim(other)
        yield ", "
    yield from _pattern(property_)
    if property_.chance is not None:
        yield f" at {property_.chance.bound} {property_.chance.probability!r}"


def _pattern(property_: Property) -> Iterator[Part]:
    before = {
        "never": "never ",
        "eventually": "eventually ",
        "possible": "always possible ",
        "again": "again and again ",
    }
    between = {"leads": " leads to ", "only": " only after ", "then": " then "}
    after = {"always": " at all times", "times": f" at most {property_.times} times"}
    yield before.get(property_.kind, "")
    for index, each in enumerate(property_.claims):
        if index:
            yield between[property_.kind]
        yield from claim(each)
    yield after.get(property_.kind, "")
    if property_.within is not None:
        yield " within "
        yield property_.within


def measure(each: Measure) -> Iterator[Part]:
    """Yield the parts of a measure: `mean each robot : time(in State)`."""
    if each.aggregate is not None:
        yield f"{each.aggregate} each {each.each} : "
    yield f"{each.over} " if each.over is not None else ""
    yield "time until " if each.kind == "until" else f"{each.kind}("
    yield from claim(each.claim)
    yield "" if each.kind == "until" else ")"


def claim(each: Claim) -> Iterator[Part]:
    """Yield the parts of a claim."""
    if isinstance(each, Junction) and each.operator == "or":
        for index, inner in enumerate(each.claims):
            yield " or " if index else ""
            yield from _conjunction(inner)
    else:
        yield from _conjunction(each)


def _conjunction(each: Claim) -> Iterator[Part]:
    if isinstance(each, Junction) and each.operator == "and":
        for index, inner in enumerate(each.claims):
            yield " and " if index else ""
            yield from _term(inner)
    else:
        yield from _term(each)


def _term(each: Claim) -> Iterator[Part]:
    match each:
        case Junction(operator="not", claims=(inner,)):
            yield "not "
            if isinstance(inner, Junction):
                yield "("
                yield from claim(inner)
                yield ")"
            else:
                yield from _term(inner)
        case Junction():
            yield "("
            yield from claim(each)
            yield ")"
        case Count():
            yield f"count({each.role} in "
            yield Named("state", each.state, each.role)
            yield f") {each.comparison} {each.number}"
        case Fact():
            yield from _fact(each)


def _fact(fact: Fact) -> Iterator[Part]:
    role = fact.robots.role if fact.robots is not None else None
    yield f"{robots(fact.robots)} " if fact.robots is not None else ""
    if fact.act == "has":
        assert fact.guard is not None
        yield "has ["
        yield Condition(fact.guard, role)
        yield "]"
        return
    yield "" if fact.act == "arrives" else f"{fact.act} "
    if fact.act == "in":
        yield Named("state", fact.name, role)
    else:
        yield Named("event" if fact.act in _EVENTS else "function", fact.name)
    yield f" as {fact.outcome}" if fact.outcome else ""
    if fact.guard is not None:
        yield " ["
        yield Condition(fact.guard, role)
        yield "]"


def robots(each: Robots) -> str:
    """Describe robots as they are written: `some other robot`, `2..3 robot`, `robot[1]`."""
    if each.quantifier == "number":
        return f"{each.number} {each.role}"
    if each.quantifier == "index":
        return each.role if each.index is None else f"{each.role}[{each.index}]"
    return f"{each.quantifier}{' other' if each.other else ''} {each.role}"


def facts_in(each: Claim) -> Iterator[Fact | Count]:
    """Yield the facts in a claim, in order."""
    if isinstance(each, Junction):
        for inner in each.claims:
            yield from facts_in(inner)
    else:
        yield each
