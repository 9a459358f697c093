"""Interfaces, events and functions."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl import ir
from swarmdsl.link_types import interface_name
from swarmdsl.load import File
from swarmdsl.lower.context import Context, type_of
from swarmdsl.lower.expressions import lower_optional
from swarmdsl.naming import snake_case
from swarmdsl.syntax import (
    ActionType,
    Communication,
    Event,
    Field,
    Function,
    FunctionPort,
    MessageType,
    Param,
    ServiceType,
    StructType,
)


def lower_interface(
    declaration: StructType | MessageType | ServiceType | ActionType, file: File
) -> ir.Interface:
    """A message, service or action; a struct is a message of the model."""
    type_ = interface_name(file, declaration.name)
    external = "/" in declaration.name
    doc, origin = declaration.doc, declaration.name.span
    match declaration:
        case ServiceType(request=request, response=response):
            return ir.Service(type_, _fields(request), _fields(response), external, doc, origin)
        case ActionType(goal=goal, result=result, feedback=feedback):
            parts = (_fields(goal), _fields(result), _fields(feedback))
            return ir.Action(type_, *parts, external, doc, origin)
        case StructType(fields=fields) | MessageType(fields=fields):
            return ir.Message(type_, _fields(fields), external, doc, origin)


def lower_event(event: Event, context: Context) -> ir.Event:
    """An event; its topic is its name where none is given."""
    return ir.Event(
        name=context.names[event],
        type=type_of(event.type),
        topic=str(event.topic) if event.topic is not None else snake_case(event.name),
        swarm=event.swarm,
        doc=event.doc,
        origin=event.name.span,
    )


def lower_function(function: Function, context: Context) -> ir.Function:
    """A function with how it is called."""
    call = next(item for item in function.items if isinstance(item, Communication))
    type_ = type_of(call.type)
    assert isinstance(type_, ir.Named)
    return ir.Function(
        name=context.names[function],
        category=function.category,
        communication=ir.Communication(call.paradigm, str(call.name), type_, call.doc, call.span),
        ports=tuple(
            ir.FunctionPort(
                item.direction, str(item.topic), type_of(item.type), item.doc, item.span
            )
            for item in function.items
            if isinstance(item, FunctionPort)
        ),
        params=lower_params(function.items, context),
        doc=function.doc,
        origin=function.name.span,
    )


def lower_params(items: Iterable[object], context: Context) -> tuple[ir.Param, ...]:
    """The params among the items of a declaration."""
    return tuple(
        ir.Param(
            str(item.name),
            type_of(item.type),
            lower_optional(item.default, context),
            item.doc,
            item.name.span,
        )
        for item in items
        if isinstance(item, Param)
    )


def _fields(fields: list[Field]) -> tuple[ir.Field, ...]:
    return tuple(
        ir.Field(str(field.name), type_of(field.type), field.doc, field.name.span)
        for field in fields
    )
