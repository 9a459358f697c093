"""Lower properties and measures."""

from __future__ import annotations

from typing import Literal, cast

from swarmdsl import ir
from swarmdsl.base.records import replace
from swarmdsl.ir.properties import Act, Kind
from swarmdsl.lowering.context import Context
from swarmdsl.lowering.expressions import lower_optional
from swarmdsl.syntax.ast import (
    Claim,
    Conjunction,
    Fact,
    Measure,
    Pattern,
    Property,
    PropertyScope,
    Term,
    Who,
    whole,
)

_KINDS: dict[str, Kind] = {
    "at all": "always",
    "at most": "times",
    "within": "eventually",
    "always": "possible",
}


def lower_property(owner: Property, context: Context) -> ir.Property:
    """Lower a property."""
    assert owner.about is not None
    body = owner.body
    later = [*([body.other] if body.other is not None else []), *body.later]
    chance = owner.chance
    return ir.Property(
        name=context.names[owner],
        subject=context.names[owner.about],
        kind=_kind(body),
        claims=tuple(_claim(each, context) for each in (body.claim, *later)),
        each=owner.each.role.name if owner.each is not None else None,
        scope=_scope(owner.scope, context) if owner.scope is not None else None,
        within=lower_optional(body.within, context),
        times=whole(body.times) if body.times else None,
        chance=ir.Chance(chance.bound, float(chance.probability)) if chance is not None else None,
        doc=owner.doc,
        origin=owner.name.span,
    )


def lower_measure(measure: Measure, context: Context) -> ir.Measure:
    """Lower a measure."""
    return ir.Measure(
        kind="until" if measure.until else measure.kind,
        claim=_claim(measure.claim, context),
        over=cast("Literal['mean', 'min', 'max'] | None", measure.over or None),
        aggregate=cast("Literal['sum', 'mean', 'min', 'max'] | None", measure.aggregate or None),
        each=measure.each.role.name if measure.each is not None else None,
    )


def _kind(body: Pattern) -> Kind:
    word = f"at {'most' if body.times else 'all'}" if body.kind == "at" else body.kind
    return _KINDS.get(word, cast("Kind", word))


def _scope(scope: PropertyScope, context: Context) -> ir.Scope:
    if scope.first is not None and scope.last is not None:
        return ir.Scope("between", (_term(scope.first, context), _term(scope.last, context)))
    claims = tuple(_claim(each, context) for each in (scope.start, scope.end) if each is not None)
    kind: Literal["after", "before", "until"] = "before" if scope.kind == "before" else "after"
    return ir.Scope("until" if len(claims) > 1 else kind, claims)


def _claim(claim: Claim, context: Context) -> ir.Claim:
    return _joined("or", [_conjunction(each, context) for each in claim.any])


def _conjunction(conjunction: Conjunction, context: Context) -> ir.Claim:
    return _joined("and", [_term(each, context) for each in conjunction.all])


def _joined(operator: Literal["and", "or"], claims: list[ir.Claim]) -> ir.Claim:
    """Join claims; those with the same operator, in parentheses, are joined too."""
    flat: list[ir.Claim] = []
    for each in claims:
        same = isinstance(each, ir.Junction) and each.operator == operator
        flat += each.claims if same and isinstance(each, ir.Junction) else (each,)
    return flat[0] if len(flat) == 1 else ir.Junction(operator, tuple(flat))


def _term(term: Term, context: Context) -> ir.Claim:
    if term.claim is not None:
        found = _claim(term.claim, context)
    else:
        assert term.fact is not None
        found = _fact(term.fact, context)
    return ir.Junction("not", (found,)) if term.negated else found


def _fact(fact: Fact, context: Context) -> ir.Fact | ir.Count:
    if fact.counted is not None:
        assert fact.state is not None
        comparison = cast("Literal['==', '!=', '<=', '>=', '<', '>']", fact.comparison)
        number = whole(fact.number)
        return ir.Count(fact.counted.name, fact.state.name, comparison, number, fact.span)
    robots = _robots(fact.who) if fact.who is not None else None
    if fact.state is not None:
        return ir.Fact("in", fact.state.name, robots, origin=fact.span)
    if fact.event is not None:
        context = replace(context, typing=context.typing.in_fact(fact))
    guard = lower_optional(fact.guard, context)
    ref = fact.event if fact.event is not None else fact.function
    if ref is None:
        return ir.Fact("has", "", robots, guard, origin=fact.span)
    act = cast("Act", fact.act or "arrives")
    return ir.Fact(act, context.name(ref), robots, guard, fact.outcome or "", fact.span)


def _robots(who: Who) -> ir.Robots:
    role = who.role.name
    if who.quantifier:
        quantifier = cast("Literal['all', 'some', 'no']", who.quantifier)
        return ir.Robots(role, quantifier, other=who.other)
    if who.lower:
        lower = 0 if who.lower == "*" else whole(who.lower)
        upper = who.upper or who.lower
        bound = None if upper == "*" else whole(upper)
        return ir.Robots(role, "number", ir.Multiplicity(lower, bound))
    return ir.Robots(role, "index", index=whole(who.index) if who.index else None)
