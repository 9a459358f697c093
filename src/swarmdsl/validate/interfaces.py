"""Events and functions."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.diagnostics import Label
from swarmdsl.graph import cycles
from swarmdsl.ir.types import Array, Named
from swarmdsl.syntax import (
    ActionType,
    Communication,
    Declaration,
    Event,
    Field,
    Function,
    FunctionPort,
    MessageType,
    Param,
    Port,
    ServiceType,
    StructType,
    TypeRef,
    Variable,
    walk,
)
from swarmdsl.validate.context import Context


def check_message_cycles(context: Context) -> None:
    """No message contains itself, in an array or through others: ROS cannot send it."""
    messages = {
        type_: node.fields
        for type_, node in context.interfaces.declared.items()
        if isinstance(node, (StructType, MessageType))
    }

    def inside(type_: Named) -> Iterator[tuple[Field, Named]]:
        for field in messages[type_]:
            element = field.type.type
            if isinstance(element, Array):
                element = element.element
            if isinstance(element, Named) and element in messages:
                yield field, element

    for type_, fields in cycles(messages, inside):
        *way, last = fields
        context.report.report(
            "type-cycle",
            last.type.span,
            name=type_.name,
            related=tuple(Label(field.type.span, "by way of this field") for field in way),
        )


def check_values(declaration: Declaration, context: Context) -> None:
    """A value is no service and no action."""
    for node in walk(declaration):
        if isinstance(node, (Field, Param, Port, Variable)):
            type_ = node.type.type
            element = type_.element if isinstance(type_, Array) else type_
            known = context.interfaces.get(element) if isinstance(element, Named) else None
            if isinstance(known, (ServiceType, ActionType)):
                context.check_kind(node.type, MessageType)


def check_known(declaration: Declaration, context: Context) -> None:
    """An interface of a package that ROS comes with exists; nearly its name is a slip."""
    for node in walk(declaration):
        if not isinstance(node, TypeRef):
            continue
        element = node.type.element if isinstance(node.type, Array) else node.type
        if not isinstance(element, Named) or context.interfaces.get(element) is not None:
            continue
        similar = context.interfaces.similar(element)
        if similar is not None:
            context.report.report(
                "unknown-interface", node.span, name=element, help=f"did you mean `{similar}`?"
            )


def check_event(event: Event, context: Context) -> None:
    """An event comes with a message."""
    context.check_kind(event.type, MessageType)


def check_function(function: Function, context: Context) -> None:
    """A function is called in one way, and its ports carry messages."""
    calls = [item for item in function.items if isinstance(item, Communication)]
    if not calls:
        context.report.report(
            "unbound-function",
            function.name.span,
            name=function.name,
            help='say how it is called, `action "cmd/name" : package/Type` for instance',
        )
    context.check_single([call.span for call in calls], "how the function is called")
    for item in function.items:
        match item:
            case Communication():
                wanted = ActionType if item.paradigm == "action" else ServiceType
                context.check_kind(item.type, wanted)
            case FunctionPort():
                context.check_kind(item.type, MessageType)
            case Param():
                context.check_default(item, item.default)
