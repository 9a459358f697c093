"""Sentences of properties: their monitors, and which of them are not covered."""

from __future__ import annotations

from swarmdsl import ir
from swarmdsl.execution.monitor import Sentence
from swarmdsl.execution.simulate.machines.expressions import function_of
from swarmdsl.execution.verify.properties.monitor_table import MOST_CLAIMS, MonitorTable
from swarmdsl.execution.verify.swarm.propositions import is_act
from swarmdsl.ir.sentences import facts_in

_LIVE = ("eventually", "leads", "then", "again")
"""Patterns that a run that goes on for ever can violate."""


def not_covered(property_: ir.Property) -> str:
    """Return the reason why a property cannot be decided without times, or ""."""
    return "it is about time" if property_.within is not None else not_shown(property_)


def not_shown(property_: ir.Property) -> str:
    """Return the reason why a property cannot be decided here, or ""."""
    scope = property_.scope.claims if property_.scope is not None else ()
    if len(property_.claims) + len(scope) > MOST_CLAIMS:
        return f"it has more than {MOST_CLAIMS} claims: split it into several properties"
    facts = list(facts_in(property_.claims[0]))
    if property_.kind == "times" and any(map(is_act, facts)):
        mixed = not all(map(is_act, facts)) or _negates(property_.claims[0])
        # It would count the moments at which nothing of the kind happens.
        mixed |= any(map(_can_be_idle, facts))
        return "it counts what happens together with what is: count one of them" if mixed else ""
    if property_.kind == "possible":
        if property_.scope is not None:
            return "`always possible` with a scope is not covered: leave out the scope"
        if any(map(is_act, facts)):
            return "`always possible` is covered for states only: use `in` and `has`"
    return ""


def _can_be_idle(fact: ir.Fact | ir.Count) -> bool:
    """Return True if a fact can hold for no robot: `no`, `all` of none, `0..2`."""
    robots = fact.robots if isinstance(fact, ir.Fact) else None
    if robots is None:
        return False
    least = robots.number.lower if robots.number is not None else 1
    return robots.quantifier in ("no", "all") or least == 0


def _negates(claim: ir.Claim) -> bool:
    if not isinstance(claim, ir.Junction):
        return False
    return claim.operator == "not" or any(map(_negates, claim.claims))


def is_about_ends(property_: ir.Property) -> bool:
    """Return True if runs that go on for ever can violate a property."""
    scope = property_.scope.kind if property_.scope is not None else None
    is_live = property_.kind in _LIVE and property_.within is None
    return is_live and scope not in ("before", "between")


def length_of(property_: ir.Property) -> int | None:
    """Return the length of `within` in nanoseconds, None if there is none."""
    within = property_.within
    return None if within is None else int(function_of(within)({}, None))


def _sentence(property_: ir.Property) -> Sentence:
    scope = property_.scope
    momentary = any(map(is_act, facts_in(property_.claims[0])))
    kind = scope.kind if scope is not None else None
    within = length_of(property_)
    return Sentence(property_.kind, kind, within, property_.times, momentary=momentary)


def table_of(property_: ir.Property) -> MonitorTable:
    """Return the monitor of a property."""
    scope = property_.scope.claims if property_.scope is not None else ()
    return MonitorTable(_sentence(property_), len(property_.claims), len(scope))
