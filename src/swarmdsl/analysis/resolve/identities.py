"""Names of robots and roles in a machine: in addresses, in `present`, and in strings.

A string is the name of a robot or role where an address, or a comparison with `self.id` and the
like, makes it one.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from swarmdsl.analysis.resolve.addresses import crews_of, named_roles, swarms_of
from swarmdsl.analysis.resolve.membership import is_member_event
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    Address,
    EventTrigger,
    ExpressionTree,
    FieldUse,
    NameUse,
    OperatorUse,
    Role,
    RoleUse,
    StateMachine,
    Transition,
    Trigger,
    Value,
    nodes_of,
    walk,
)

_ROBOT = re.compile(r"(.*)\[(0|[1-9]\d{0,17})\]", re.DOTALL)
_FACTS = {"id": False, "role": True}


@dataclass(frozen=True)
class Comparison:
    """`==` or `!=` between who a robot is, `fact`, and a string: its role if `of_role`, or its id.

    `triggers` are those of the transition, for a fact about the event.
    """

    fact: FieldUse
    value: Value
    of_role: bool
    triggers: Sequence[Trigger] = ()


def robot_named(name: str) -> tuple[str, int | None]:
    """Return the role and the number in the id of a robot, `"uav[2]"`; the name of a role alone."""
    found = _ROBOT.fullmatch(name)
    return (found[1], int(found[2])) if found is not None else (name, None)


def comparisons(machine: StateMachine) -> Iterator[Comparison]:
    """Yield the comparisons of robots and roles with strings."""
    compared = [
        (use, *pair)
        for use in nodes_of(machine, OperatorUse)
        if use.operator in ("==", "!=")
        for pair in (use.operands, use.operands[::-1])
    ]
    around: dict[OperatorUse, Transition] | None = None
    for use, fact, value in compared:
        match fact, value:
            case FieldUse(base=NameUse(name="self"), name=name), Value(value=str()):
                if name in _FACTS:
                    yield Comparison(fact, value, _FACTS[name])
            case FieldUse(base=NameUse(name="event"), name=name), Value(value=str()):
                if around is None:
                    around = _transitions(machine)
                triggers = around[use].triggers if use in around else ()
                of_members = all(map(_is_of_member, triggers))
                if triggers and ((of_members and name in _FACTS) or name == "sender"):
                    yield Comparison(fact, value, _FACTS.get(name, False), triggers)


def role_uses(machine: StateMachine, project: Project) -> Iterator[tuple[Span, Role]]:
    """Yield the places in a machine that name a role, in each swarm that runs it."""
    strings = [(text, robot_named(str(text.value))[0]) for text in _strings(machine)]
    places = [(use.span, str(use.name)) for use in nodes_of(machine, RoleUse)]
    places += [(_inside(text.span, len(name)), name) for text, name in strings]
    if not places and not nodes_of(machine, Address):
        return
    crews = crews_of(swarms_of(project))
    for named in named_roles(machine, crews):
        if named.role is not None:
            yield named.span, named.role
    for crew in crews:
        for span, name in places if machine in crew.machines else ():
            # A string with escapes has another text.
            if name in crew.roles and span.text == name:
                yield span, crew.roles[name]


def _inside(quoted: Span, length: int) -> Span:
    """Return the place of the first characters of a string."""
    return Span(quoted.source, quoted.start + 1, quoted.start + 1 + length)


def _strings(machine: StateMachine) -> Iterator[Value]:
    ids: list[ExpressionTree | None] = [each.id.tree for each in nodes_of(machine, Address)]
    for tree in ids:
        if isinstance(tree, Value) and isinstance(tree.value, str):
            yield tree
    yield from (each.value for each in comparisons(machine))


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
