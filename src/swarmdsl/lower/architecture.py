"""Components, members, swarms and environments."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl import ir
from swarmdsl.lower.context import Context, type_of
from swarmdsl.lower.expressions import lower_expression
from swarmdsl.lower.interfaces import lower_params
from swarmdsl.naming import snake_case
from swarmdsl.syntax import (
    BehaviorUse,
    Component,
    Connector,
    Environment,
    EnvironmentUse,
    Member,
    Multiplicity,
    Part,
    Port,
    PortRef,
    Role,
    Size,
    Swarm,
    World,
    in_metres,
)


def lower_component(component: Component, context: Context) -> ir.Component:
    """A component with its ports and params."""
    return ir.Component(
        name=context.names[component],
        kind=component.kind,
        ports=_ports(component.items),
        params=lower_params(component.items, context),
        doc=component.doc,
        origin=component.name.span,
    )


def lower_member(member: Member, context: Context) -> ir.Member:
    """A member with its parts and connectors."""
    behavior = next((item for item in member.items if isinstance(item, BehaviorUse)), None)
    return ir.Member(
        name=context.names[member],
        behavior=context.name(behavior.machine) if behavior else None,
        ports=_ports(member.items),
        params=lower_params(member.items, context),
        parts=tuple(_part(item, context) for item in member.items if isinstance(item, Part)),
        connectors=tuple(
            ir.Connector(_end(item.source), _end(item.target), item.span)
            for item in member.items
            if isinstance(item, Connector)
        ),
        doc=member.doc,
        origin=member.name.span,
    )


def lower_swarm(swarm: Swarm, context: Context) -> ir.Swarm:
    """A swarm with its roles."""
    place = next((item for item in swarm.items if isinstance(item, EnvironmentUse)), None)
    return ir.Swarm(
        name=context.names[swarm],
        roles=tuple(
            ir.Role(
                str(item.name),
                context.name(item.member),
                _multiplicity(item.multiplicity),
                item.doc,
                item.name.span,
            )
            for item in swarm.items
            if isinstance(item, Role)
        ),
        environment=context.name(place.environment) if place else None,
        doc=swarm.doc,
        origin=swarm.name.span,
    )


def lower_environment(environment: Environment, context: Context) -> ir.Environment:
    """An environment, lengths in metres."""
    world = next((item for item in environment.items if isinstance(item, World)), None)
    size = next((item for item in environment.items if isinstance(item, Size)), None)
    return ir.Environment(
        name=context.names[environment],
        world=str(world.file) if world else None,
        size=_size(size) if size else None,
        doc=environment.doc,
        origin=environment.name.span,
    )


def _ports(items: Iterable[object]) -> tuple[ir.Port, ...]:
    return tuple(
        ir.Port(
            str(item.name),
            item.direction,
            type_of(item.type),
            str(item.topic) if item.topic is not None else snake_case(item.name),
            item.doc,
            item.name.span,
        )
        for item in items
        if isinstance(item, Port)
    )


def _part(part: Part, context: Context) -> ir.Part:
    return ir.Part(
        name=str(part.name),
        component=context.name(part.component),
        values=tuple(
            (str(value.name), lower_expression(value.value, context)) for value in part.values
        ),
        doc=part.doc,
        origin=part.name.span,
    )


def _end(end: PortRef) -> ir.PortRef:
    return ir.PortRef(end.part.name if end.part is not None else None, end.port.name)


def _multiplicity(multiplicity: Multiplicity | None) -> ir.Multiplicity:
    if multiplicity is None:
        return ir.Multiplicity(1, 1)
    if multiplicity.lower == "*":
        return ir.Multiplicity(0, None)
    lower, upper = multiplicity.lower, multiplicity.upper or multiplicity.lower
    return ir.Multiplicity(int(lower), None if upper == "*" else int(upper))


def _size(size: Size) -> tuple[float, ...]:
    lengths = [size.width, size.depth, *([size.height] if size.height else [])]
    return tuple(map(in_metres, lengths))
