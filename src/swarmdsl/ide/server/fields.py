"""Names that take a value: fields of goals, messages and structs, params."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.analysis.called_interface import call_fields
from swarmdsl.analysis.event_typing import in_transition
from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.analysis.resolve.set_params import set_params
from swarmdsl.analysis.types import Typing
from swarmdsl.base.records import dataclass
from swarmdsl.ide.server.speculative_parse import PLACEHOLDER
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    Activity,
    Argument,
    Contract,
    Fact,
    Field,
    FieldUse,
    NameUse,
    Node,
    Param,
    Parameter,
    PartValue,
    ResultMapping,
    Send,
    State,
    StateMachine,
    TopLevel,
    Transition,
    Word,
    nodes_of,
    walk,
)
from swarmdsl.syntax.types import ENVELOPE_FIELDS, MEMBER, Named, Type

Slot = Field | Parameter | Param


@dataclass(frozen=True)
class Slots:
    """Parameters of a call, with its name and those already assigned."""

    callee: str
    fields: Sequence[Slot]
    assigned: frozenset[str] = frozenset()

    @property
    def unassigned(self) -> list[Slot]:
        """Return the parameters that are not assigned yet."""
        return [each for each in self.fields if each.name not in self.assigned]


def slots(owner: TopLevel, project: Project) -> Slots | None:
    """Return the parameter list in which the placeholder is a name or a value."""
    interfaces = Interfaces(project.declarations())
    for activity in nodes_of(owner, Activity):
        taken, given = call_fields(activity.function.target, interfaces)
        if _any_placeholder(activity.arguments):
            return Slots(activity.function.name, taken, _names(activity.arguments))
        if any(_has_placeholder(each) for each in activity.results):
            results = frozenset(str(each.field) for each in activity.results)
            return Slots(activity.function.name, given, results)
    for send in nodes_of(owner, Send):
        if _any_placeholder(send.arguments):
            event = send.event.target
            type_ = event.type.type if event is not None else None
            return Slots(send.event.name, _fields(type_, interfaces), _names(send.arguments))
    for state in nodes_of(owner, State):
        machine = state.machine.target if state.machine is not None else None
        if _any_placeholder(state.bindings) and isinstance(machine, StateMachine):
            params = [each for each in machine.items if isinstance(each, Param)]
            return Slots(str(machine.name), params, _names(state.bindings))
    for of, values in set_params(owner):
        if _any_placeholder(values):
            return Slots(str(of.name), all_items(of, Param), _names(values))
    return None


def fields_of(use: FieldUse, owner: TopLevel, project: Project) -> Sequence[Field]:
    """Return the fields of the type of the placeholder's base."""
    typing = Typing(Interfaces(project.declarations()))
    type_ = with_event(use, owner, typing).infer(use.base)
    return _fields(type_, typing.interfaces)


def facts_of(use: FieldUse, owner: TopLevel, project: Project) -> dict[str, Type]:
    """Return the types of the facts about an event that its message does not hide."""
    if not (isinstance(use.base, NameUse) and use.base.name == "event"):
        return {}
    typing = with_event(use, owner, Typing(Interfaces(project.declarations())))
    if not typing.of_swarm:
        return {}
    return {name: type_ for name, type_ in ENVELOPE_FIELDS.items() if typing.is_envelope(name)}


def is_of_member(use: FieldUse, owner: TopLevel, project: Project) -> bool:
    """Return True for a field of `event` where it says which robot joined or was lost."""
    if not (isinstance(use.base, NameUse) and use.base.name == "event"):
        return False
    typing = with_event(use, owner, Typing(Interfaces(project.declarations())))
    return typing.event == MEMBER


def with_event(use: Node, owner: TopLevel, typing: Typing) -> Typing:
    """Return the typing at a node of an expression, with the event that triggers or happens."""
    for fact in nodes_of(owner, Fact):
        if fact.guard is not None and any(node is use for node in walk(fact.guard)):
            return typing.in_fact(fact)
    reacting: list[Transition | Contract] = [*nodes_of(owner, Transition)]
    reacting += nodes_of(owner, Contract)
    for transition in reacting:
        if any(node is use for node in walk(transition)):
            return in_transition(transition, typing)
    return typing


def _fields(type_: Type | None, interfaces: Interfaces) -> Sequence[Field]:
    return (interfaces.fields(type_) if isinstance(type_, Named) else None) or ()


def _any_placeholder(arguments: Sequence[Argument | PartValue]) -> bool:
    return any(_has_placeholder(each) for each in arguments)


def _has_placeholder(given: Argument | PartValue | ResultMapping) -> bool:
    return PLACEHOLDER in given.span.text


def _names(arguments: Sequence[Argument | PartValue]) -> frozenset[str]:
    return frozenset(str(each.name) for each in arguments)


def is_placeholder_name(owner: TopLevel) -> bool:
    """Return True if the placeholder is a parameter name, not part of a value."""
    names: list[Word] = [each.name for each in nodes_of(owner, Argument)]
    names += [each.name for each in nodes_of(owner, PartValue)]
    names += [each.field for each in nodes_of(owner, ResultMapping)]
    return PLACEHOLDER in names
