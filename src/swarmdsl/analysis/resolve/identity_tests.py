"""Comparisons in a machine of who a robot is, with any value."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl.analysis.resolve.membership import is_member_event
from swarmdsl.base.records import dataclass
from swarmdsl.syntax.ast import (
    EventTrigger,
    ExpressionTree,
    FieldUse,
    NameUse,
    OperatorUse,
    StateMachine,
    Transition,
    Trigger,
    nodes_of,
    walk,
)

_FACTS = {"id": False, "role": True}


@dataclass(frozen=True)
class IdentityTest:
    """`==` or `!=` between who a robot is, `fact`, and a value: its role if `of_role`, or its id.

    `triggers` are those of the transition, for a fact about the event.
    """

    fact: FieldUse
    value: ExpressionTree
    of_role: bool
    triggers: Sequence[Trigger] = ()


def identity_tests(machine: StateMachine) -> Iterator[IdentityTest]:
    """Yield the comparisons of robots and roles with other values."""
    compared = [
        (use, *pair)
        for use in nodes_of(machine, OperatorUse)
        if use.operator in ("==", "!=")
        for pair in (use.operands, use.operands[::-1])
    ]
    around: dict[OperatorUse, Transition] | None = None
    for use, fact, value in compared:
        match fact:
            case FieldUse(base=NameUse(name="self"), name=name):
                if name in _FACTS:
                    yield IdentityTest(fact, value, _FACTS[name])
            case FieldUse(base=NameUse(name="event"), name=name):
                if around is None:
                    around = _transitions(machine)
                triggers = around[use].triggers if use in around else ()
                of_members = all(map(_is_of_member, triggers))
                if triggers and ((of_members and name in _FACTS) or name == "sender"):
                    yield IdentityTest(fact, value, _FACTS.get(name, False), triggers)


def _transitions(machine: StateMachine) -> dict[OperatorUse, Transition]:
    """Return the transition around each operation in a guard or effect."""
    return {
        node: transition
        for transition in nodes_of(machine, Transition)
        for node in walk(transition)
        if isinstance(node, OperatorUse)
    }


def _is_of_member(trigger: Trigger) -> bool:
    return isinstance(trigger, EventTrigger) and is_member_event(trigger.event.target)
