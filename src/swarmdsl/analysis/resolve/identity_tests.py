"""Comparisons in a machine of who a robot is, with any value."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl.analysis.resolve.membership import is_member_event
from swarmdsl.base.records import dataclass
from swarmdsl.syntax.ast import (
    EventTrigger,
    ExpressionTree,
    Fact,
    FieldUse,
    NameUse,
    Node,
    OperatorUse,
    TopLevel,
    Transition,
    Trigger,
    nodes_of,
    walk,
)

_FACTS = {"id": False, "role": True}


@dataclass(frozen=True)
class IdentityTest:
    """`==` or `!=` between who a robot is, `fact`, and a value: its role if `of_role`, or its id.

    A fact about an event is in a transition with `triggers`, or in the condition of `around`, that
    of a property or a measure.
    """

    fact: FieldUse
    value: ExpressionTree
    of_role: bool
    triggers: Sequence[Trigger] = ()
    around: Fact | None = None


def identity_tests(owner: TopLevel) -> Iterator[IdentityTest]:
    """Yield the comparisons of robots and roles with other values."""
    compared = [
        (use, *pair)
        for use in nodes_of(owner, OperatorUse)
        if use.operator in ("==", "!=")
        for pair in (use.operands, use.operands[::-1])
    ]
    around: dict[OperatorUse, Transition] | None = None
    conditions = {node: fact for fact in nodes_of(owner, Fact) for node in _operations(fact.guard)}
    for use, fact, value in compared:
        match fact:
            case FieldUse(base=NameUse(name="self"), name=name):
                if name in _FACTS:
                    yield IdentityTest(fact, value, _FACTS[name])
            case FieldUse(base=NameUse(name="event"), name=name) if use in conditions:
                heard = conditions[use]
                event = heard.event.target if heard.event is not None else None
                of_member = is_member_event(event) and name in _FACTS
                if heard.act == "hears" and (of_member or name == "sender"):
                    yield IdentityTest(fact, value, _FACTS.get(name, False), around=heard)
            case FieldUse(base=NameUse(name="event"), name=name):
                if around is None:
                    around = _transitions(owner)
                triggers = around[use].triggers if use in around else ()
                of_members = all(map(_is_of_member, triggers))
                if triggers and ((of_members and name in _FACTS) or name == "sender"):
                    yield IdentityTest(fact, value, _FACTS.get(name, False), triggers)


def _transitions(owner: TopLevel) -> dict[OperatorUse, Transition]:
    """Return the transition around each operation in a guard or effect."""
    return {node: each for each in nodes_of(owner, Transition) for node in _operations(each)}


def _operations(around: Node | None) -> Iterator[OperatorUse]:
    for node in walk(around) if around is not None else ():
        if isinstance(node, OperatorUse):
            yield node


def _is_of_member(trigger: Trigger) -> bool:
    return isinstance(trigger, EventTrigger) and is_member_event(trigger.event.target)
