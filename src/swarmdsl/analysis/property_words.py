"""The meaning of a property in words: one sentence with its chance, robots, scope and pattern."""

from __future__ import annotations

from decimal import Decimal

from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.syntax.ast import (
    Chance,
    Claim,
    Fact,
    Pattern,
    Property,
    PropertyScope,
    Term,
    Who,
)

_COMPARED = {
    "==": "exactly",
    "<": "fewer than",
    ">": "more than",
    "<=": "at most",
    ">=": "at least",
    "!=": "any number except",
}
_DONE = {
    "sends": "sends",
    "hears": "hears",
    "starts": "calls",
    "cancels": "cancels its call of",
    "ends": "completes its call of",
}


def in_words(owner: Property) -> str:
    """Return the meaning of a property as a sentence, with names in backquotes.

    >>> in_words(lands)  # property Lands : each uav : after Abort, in Landed within 30 s
    'In each run of swarm `Rescue`, for each `uav` by itself: from the first time that `Abort`
    arrives from outside, within `30 s` it is in `Landed`.'
    """
    each = owner.each
    about = f"`{owner.about.name}`" if owner.about is not None else "the model"
    kind = f"{kind_name(owner.about)} " if owner.about is not None else ""
    robots = f", for each `{each.role.name}` by itself" if each is not None else ""
    scope = f"{_scope(owner.scope)}, " if owner.scope is not None else ""
    return f"{_runs(owner.chance)} of {kind}{about}{robots}: {scope}{_pattern(owner.body)}."


def _runs(chance: Chance | None) -> str:
    if chance is None:
        return "In each run"
    percent = (Decimal(chance.probability) * 100).normalize()
    return f"In at {chance.bound} {percent:f} % of all runs"


def _scope(scope: PropertyScope) -> str:
    if scope.first is not None and scope.last is not None:
        first, last = _term(scope.first), _term(scope.last)
        return f"between each time that {first} and the next time that {last}, if that comes"
    start = _claim(scope.start) if scope.start is not None else ""
    end = _claim(scope.end) if scope.end is not None else ""
    if not start:
        return f"before the first time that {end}, if that comes"
    if end:
        return f"from each time that {start} up to the next time that {end}, or to the end"
    return f"from the first time that {start}"


def _pattern(body: Pattern) -> str:
    holds = _claim(body.claim)
    other = _claim(body.other) if body.other is not None else ""
    within = f"`{body.within.span.text}`" if body.within is not None else ""
    match body.kind:
        case "never":
            return f"it never happens that {holds}"
        case "at" if body.times:
            return f"it happens at most {_times(body.times)} that {holds}"
        case "at":
            return f"it is true at all times that {holds}"
        case "leads":
            late = f"within {within}" if within else "later"
            return f"whenever {holds}, then or {late} {other}"
        case "only":
            return f"{holds} only if before, or at the same moment, {other}"
        case "then":
            later = "".join(f", and then or later {_claim(each)}" for each in body.later)
            return f"at some time {holds}{later}"
        case "again":
            return f"again and again {holds}, and so at the end of a run that ends"
        case "always":
            return f"it stays possible that {holds}, and is so at the end of a run that ends"
    return f"{f'within {within}' if within else 'at some time'} {holds}"


def _times(number: str) -> str:
    return "once" if number == "1" else f"{number} times"


def _claim(claim: Claim) -> str:
    return " or ".join(" and ".join(map(_term, each.all)) for each in claim.any)


def _term(term: Term) -> str:
    negation = "it is not so that " if term.negated else ""
    if term.claim is not None:
        claim = _claim(term.claim)
        return f"{negation}({claim})" if _joins(term.claim) else f"{negation}{claim}"
    assert term.fact is not None
    return f"{negation}{_fact(term.fact)}"


def _joins(claim: Claim) -> bool:
    return len(claim.any) > 1 or len(claim.any[0].all) > 1


def _fact(fact: Fact) -> str:
    if fact.counted is not None and fact.state is not None:
        number = f"{_COMPARED[fact.comparison]} {fact.number}"
        return f"{number} `{fact.counted.name}` are in `{fact.state.name}`"
    message = ""
    if fact.event is not None and fact.guard is not None:
        message = f" with `{fact.guard.span.text}`"
    if fact.who is None and not fact.act and fact.event is not None:
        return f"`{fact.event.name}`{message} arrives from outside"
    who, several = _who(fact.who) if fact.who is not None else ("it", False)
    if fact.state is not None:
        return f"{who} {'are' if several else 'is'} in `{fact.state.name}`"
    if fact.guard is not None and fact.event is None:
        return f"{who} {'have' if several else 'has'} `{fact.guard.span.text}`"
    ref = fact.event if fact.event is not None else fact.function
    done = _DONE[fact.act]
    if several:
        done = done.replace("s its", " their") if " its " in done else done.removesuffix("s")
    outcome = f" as `{fact.outcome}`" if fact.outcome else ""
    return f"{who} {done} `{ref.name if ref is not None else ''}`{message}{outcome}"


def _who(who: Who) -> tuple[str, bool]:
    """Return the robots in words, and True if they are several."""
    role = f"`{who.role.name}`"
    if who.quantifier:
        other = "other " if who.other else ""
        return f"{who.quantifier} {other}{role}", who.quantifier == "all"
    if not who.lower:
        return f"`{who.role.name}[{who.index}]`" if who.index else role, False
    if not who.upper:
        return f"exactly {who.lower} {role}", who.lower != "1"
    if who.upper == "*":
        return f"at least {0 if who.lower == '*' else who.lower} {role}", who.lower != "1"
    return f"{who.lower} to {who.upper} {role}", True
