"""Lower interfaces, events and functions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl import ir
from swarmdsl.analysis.event_topics import topic_of
from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.membership import is_member_event
from swarmdsl.analysis.resolve.type_names import interface_name
from swarmdsl.analysis.types.enum_values import numbers, underlying
from swarmdsl.lowering.context import Context, operations_of
from swarmdsl.lowering.expressions import lower_expression, lower_fields, lower_optional
from swarmdsl.lowering.space import lower_model
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    ActionType,
    Communication,
    Component,
    Constant,
    DeliverySetting,
    EnumType,
    Event,
    Field,
    Function,
    FunctionPort,
    Member,
    MessageType,
    Operation,
    Param,
    Part,
    PartValue,
    ServiceType,
    StructType,
)
from swarmdsl.syntax.types import INT


def lower_interface(
    declaration: StructType | EnumType | MessageType | ServiceType | ActionType,
    file: File,
    context: Context,
) -> ir.Interface:
    """Lower a message, service or action; a struct is a message of the model."""
    type_ = interface_name(file, declaration.name)
    external = "/" in declaration.name
    doc, origin = declaration.doc, declaration.name.span
    match declaration:
        case ServiceType(request=request, response=response):
            return ir.Service(
                type_, _fields(request, context), _fields(response, context), external, doc, origin
            )
        case ActionType(goal=goal, result=result, feedback=feedback):
            return ir.Action(
                type_,
                _fields(goal, context),
                _fields(result, context),
                _fields(feedback, context),
                external,
                doc,
                origin,
            )
        case EnumType():
            return ir.Message(type_, (), external, _values(declaration), doc, origin)
        case StructType(fields=fields):
            return ir.Message(type_, _fields(fields, context), external, (), doc, origin)
        case MessageType(fields=fields, constants=constants):
            values = tuple(_constant(constant, context) for constant in constants)
            return ir.Message(type_, _fields(fields, context), external, values, doc, origin)


def _values(enum: EnumType) -> tuple[ir.Constant, ...]:
    """Return the constants of an enum, which in ROS is a message of constants."""
    known, type_ = numbers(enum), underlying(enum)
    return tuple(
        ir.Constant(
            str(value.name),
            type_,
            ir.Literal(known[str(value.name)], INT, value.span),
            value.doc,
            value.name.span,
        )
        for value in enum.values
    )


def _constant(constant: Constant, context: Context) -> ir.Constant:
    return ir.Constant(
        str(constant.name),
        context.type_of(constant.type),
        lower_expression(constant.value, context, constant.type.type),
        constant.doc,
        constant.name.span,
    )


def lower_services(component: Component, context: Context) -> Iterator[ir.Service]:
    """Yield the services of the component's own operations, in its package."""
    for operation in component.items:
        if not isinstance(operation, Operation):
            continue
        fields = {
            direction: tuple(
                ir.Field(str(p.name), context.type_of(p.type), p.doc, p.name.span)
                for p in operation.parameters
                if (p.direction or "in") == direction
            )
            for direction in ("in", "out")
        }
        yield ir.Service(
            context.services[operation],
            fields["in"],
            fields["out"],
            False,
            operation.doc,
            operation.name.span,
        )


def lower_operations(owner: Component | Part, context: Context) -> Iterator[ir.Function]:
    """Yield the functions of an owner's operations, inherited ones first."""
    namespace = context.namespace(owner)
    for operation in operations_of(owner):
        origin = operation.name.span
        server = f"{namespace}/{operation.name}"
        call = ir.Communication("service", server, context.services[operation], "", origin)
        name = context.operations[namespace, operation]
        yield ir.Function(name, "abstraction", call, (), (), operation.doc, origin)


def lower_event(event: Event, context: Context) -> ir.Event:
    """Lower an event; its topic defaults to its name, and it has the comments of its delivery."""
    return ir.Event(
        name=context.names[event],
        type=context.type_of(event.type),
        topic=topic_of(event),
        swarm=event.swarm,
        doc="\n".join(filter(None, (event.doc, *(each.doc for each in event.delivery)))),
        origin=event.name.span,
        delivery=_lower_delivery(event.delivery, context) if event.delivery else None,
        predefined=is_member_event(event),
        operator=event.operator,
    )


def _lower_delivery(settings: list[DeliverySetting], context: Context) -> ir.Delivery:
    """Lower the settings of a delivery to their values."""
    kinds = {each.kind: each for each in settings}
    values: dict[str, int] = {}
    for name, setting in kinds.items():
        if setting.value is not None and setting.value.tree is not None:
            value = context.typing.folding.value(setting.value.tree)
            assert isinstance(value, (int, float))
            values[name] = round(value)
    return ir.Delivery(
        reliable="reliable" in kinds if kinds.keys() & {"reliable", "best"} else None,
        latest="latest" in kinds,
        keep=values.get("keep"),
        lifespan=values.get("lifespan"),
        deadline=values.get("deadline"),
        origin=settings[0].span,
    )


def lower_function(function: Function, context: Context) -> ir.Function:
    """Lower a function with its call."""
    call = next(item for item in function.items if isinstance(item, Communication))
    type_ = context.type_of(call.type)
    assert isinstance(type_, ir.Named)
    return ir.Function(
        name=context.names[function],
        category=function.category,
        communication=ir.Communication(call.paradigm, str(call.name), type_, call.doc, call.span),
        ports=tuple(
            ir.FunctionPort(
                item.direction, str(item.topic), context.type_of(item.type), item.doc, item.span
            )
            for item in function.items
            if isinstance(item, FunctionPort)
        ),
        params=lower_params(function.items, context),
        doc=function.doc,
        origin=function.name.span,
        model=lower_model(function, context),
    )


def lower_params(items: Iterable[object], context: Context) -> tuple[ir.Param, ...]:
    """Return the params among the items of a declaration."""
    return tuple(
        ir.Param(
            str(item.name),
            context.type_of(item.type),
            lower_optional(item.default, context, item.type.type),
            item.doc,
            item.name.span,
        )
        for item in items
        if isinstance(item, Param)
    )


def lower_values(
    values: Iterable[PartValue], owner: Component | Member | None, context: Context
) -> tuple[tuple[str, ir.Expression], ...]:
    """Return the values that params of an owner get."""
    params = all_items(owner, Param) if owner is not None else []
    return lower_fields(values, params, context)


def _fields(fields: list[Field], context: Context) -> tuple[ir.Field, ...]:
    return tuple(
        ir.Field(str(field.name), context.type_of(field.type), field.doc, field.name.span)
        for field in fields
    )
