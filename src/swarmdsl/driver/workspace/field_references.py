"""Find the references to fields, which are known by the type of what they belong to."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.analysis.called_interface import call_fields
from swarmdsl.analysis.event_typing import in_transition
from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.analysis.types import Typing
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    ActionType,
    Activity,
    Argument,
    Construction,
    Fact,
    Field,
    FieldUse,
    MessageType,
    Node,
    Parameter,
    ResultMapping,
    Send,
    ServiceType,
    StructType,
    TopLevel,
    Transition,
    Word,
    nodes_of,
    walk,
)
from swarmdsl.syntax.types import MEMBER, Named, Type

Slot = Field | Parameter
FIELDS = (Field, Parameter)


def field_references(owner: TopLevel, interfaces: Interfaces) -> Iterator[tuple[Span, Slot]]:
    """Yield the names of fields in a declaration, with what declares them."""
    for activity in nodes_of(owner, Activity):
        taken, given = call_fields(activity.function.target, interfaces)
        yield from _named(activity.arguments, taken)
        yield from _named(activity.results, given)
    for send in nodes_of(owner, Send):
        event = send.event.target
        type_ = event.type.type if event is not None else None
        yield from _named(send.arguments, _fields(type_, interfaces))
    for built in nodes_of(owner, Construction):
        fields = {str(each.name): each for each in _fields(built.type.type, interfaces)}
        for value in built.values:
            if str(value.name) in fields:
                yield value.name.span.absolute, fields[str(value.name)]
    yield from _accesses(owner, interfaces)


def _accesses(owner: TopLevel, interfaces: Interfaces) -> Iterator[tuple[Span, Slot]]:
    """Yield the fields after a dot."""
    uses = nodes_of(owner, FieldUse)
    if not uses:
        return
    plain = Typing(interfaces)
    typings: dict[Node, Typing] = {}
    for transition in nodes_of(owner, Transition):
        inside = [each for each in walk(transition) if isinstance(each, FieldUse)]
        typings |= dict.fromkeys(inside, in_transition(transition, plain)) if inside else {}
    for fact in nodes_of(owner, Fact):
        if fact.guard is not None:
            typings |= dict.fromkeys(walk(fact.guard), plain.in_fact(fact))
    for use in uses:
        type_ = typings.get(use, plain).quietly(use.base)
        # What heartbeats raise is declared nowhere.
        for field in _fields(type_, interfaces) if type_ != MEMBER else ():
            if field.name == use.name:
                yield use.name.span.absolute, field


def _fields(type_: Type | None, interfaces: Interfaces) -> list[Field]:
    return (interfaces.fields(type_) if isinstance(type_, Named) else None) or []


def _named(
    uses: Iterable[Argument | ResultMapping], fields: Iterable[Slot]
) -> Iterator[tuple[Span, Slot]]:
    known = {str(each.name): each for each in fields}
    for use in uses:
        name: Word = use.field if isinstance(use, ResultMapping) else use.name
        if str(name) in known:
            yield name.span.absolute, known[str(name)]


def part_with(field: Field, owner: Node) -> str:
    """Return the part of an interface that a field is in: "goal", or "" for a message."""
    parts: dict[str, list[Field]] = {}
    match owner:
        case ActionType(goal=goal, result=result, feedback=feedback):
            parts = {"goal": goal, "result": result, "feedback": feedback}
        case ServiceType(request=request, response=response):
            parts = {"request": request, "response": response}
        case MessageType(fields=fields) | StructType(fields=fields):
            parts = {"": fields}
    return next((part for part, fields in parts.items() if field in fields), "")
