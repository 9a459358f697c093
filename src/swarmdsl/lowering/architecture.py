"""Components, members, swarms and environments."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl import ir
from swarmdsl.analysis.port_groups import PortKey, PortTopic, port_groups
from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.base.naming import snake_case
from swarmdsl.base.numerals import integer
from swarmdsl.base.records import replace
from swarmdsl.lowering.context import Context
from swarmdsl.lowering.docs import lower_docs
from swarmdsl.lowering.expressions import lower_optional
from swarmdsl.lowering.interfaces import lower_params, lower_values
from swarmdsl.lowering.space import (
    lower_equipment,
    lower_geometry,
    lower_sights,
    lower_start,
)
from swarmdsl.syntax.ast import (
    BehaviorUse,
    CommunicationSettings,
    Component,
    Connector,
    Contract,
    Environment,
    EnvironmentUse,
    FitnessUse,
    Heartbeat,
    Member,
    Multiplicity,
    Param,
    Part,
    Port,
    PortRef,
    RobotValues,
    Role,
    Size,
    Swarm,
    World,
    in_metres,
)


def lower_component(component: Component, context: Context) -> ir.Component:
    """Lower a component with its ports and params."""
    return ir.Component(
        name=context.names[component],
        kind=component.kind,
        ports=_ports(all_items(component, Port), context),
        params=lower_params(all_items(component, Param), context),
        operations=context.offered(component),
        behavior=_behavior(component, context),
        base=context.name(component.base) if component.base is not None else None,
        doc=component.doc,
        docs=lower_docs(all_items(component, BehaviorUse)),
        origin=component.name.span,
        sights=lower_sights(component, context),
    )


def lower_member(member: Member, context: Context) -> ir.Member:
    """Lower a member with its parts and connectors."""
    ports = _ports(all_items(member, Port), context)
    connectors = tuple(
        ir.Connector(_end(item.source), _end(item.target), item.doc, item.span)
        for item in all_items(member, Connector)
    )
    equipment = {
        kind: lower_equipment(member, kind, context) for kind in ("body", "battery", "radio")
    }
    docs = (doc for _, found in equipment.values() for doc in found)
    return ir.Member(
        name=context.names[member],
        behavior=_behavior(member, context),
        ports=ports,
        params=lower_params(all_items(member, Param), context),
        parts=tuple(_part(part, context) for part in all_items(member, Part)),
        connectors=connectors,
        communication=_communication(member, context),
        base=context.name(member.base) if member.base is not None else None,
        doc=member.doc,
        docs=tuple(sorted((*lower_docs(all_items(member, BehaviorUse)), *docs))),
        origin=member.name.span,
        port_groups=tuple(_port_groups(member, ports, connectors, context)),
        contracts=tuple(_contract(item, context) for item in all_items(member, Contract)),
        **{kind: values for kind, (values, _) in equipment.items()},
    )


def _contract(contract: Contract, context: Context) -> ir.Contract:
    types = [each.event.target.type.type for each in contract.triggers if each.event.target]
    hearing = context
    if types:
        of_swarm = all(each.event.target and each.event.target.swarm for each in contract.triggers)
        hearing = context.with_event([each for each in types if each], of_swarm=of_swarm)
    return ir.Contract(
        str(contract.name),
        tuple(dict.fromkeys(context.name(each.event) for each in contract.triggers)),
        lower_optional(contract.guard, hearing),
        lower_optional(contract.within, context),
        tuple(each.state.name for each in contract.states),
        context.name(contract.function) if contract.function is not None else None,
        contract.doc,
        contract.name.span,
    )


def lower_swarm(swarm: Swarm, context: Context) -> ir.Swarm:
    """Lower a swarm with its roles."""
    place = next((item for item in swarm.items if isinstance(item, EnvironmentUse)), None)
    fitness = next((item for item in swarm.items if isinstance(item, FitnessUse)), None)
    robots: dict[str, list[RobotValues]] = {}
    for item in swarm.items:
        if isinstance(item, RobotValues):
            robots.setdefault(item.role.name, []).append(item)
    return ir.Swarm(
        name=context.names[swarm],
        roles=tuple(
            _role(item, robots.get(str(item.name), ()), context)
            for item in swarm.items
            if isinstance(item, Role)
        ),
        environment=context.name(place.environment) if place else None,
        fitness=context.name(fitness.fitness) if fitness else None,
        doc=swarm.doc,
        docs=lower_docs(swarm.items),
        origin=swarm.name.span,
        heartbeat=_heartbeat(swarm, context),
    )


def _heartbeat(swarm: Swarm, context: Context) -> ir.Heartbeat | None:
    item = next((item for item in swarm.items if isinstance(item, Heartbeat)), None)
    if item is None:
        return None
    values = []
    for given in (item.period, item.timeout):
        assert given.tree is not None
        value = context.typing.folding.value(given.tree)
        assert isinstance(value, (int, float))
        values.append(round(value))
    period, timeout = values
    return ir.Heartbeat(period, timeout, item.doc, item.span)


def _role(role: Role, robots: Iterable[RobotValues], context: Context) -> ir.Role:
    return ir.Role(
        str(role.name),
        context.name(role.member),
        _multiplicity(role.multiplicity),
        lower_values(role.values, role.member.target, context),
        tuple(
            ir.RobotValues(
                integer(robot.index),
                lower_values(robot.values, role.member.target, context),
                robot.doc,
                lower_docs(robot.values),
                robot.span,
                lower_start(robot.start, context),
            )
            for robot in sorted(robots, key=lambda robot: integer(robot.index))
        ),
        role.doc,
        lower_docs(role.values),
        role.name.span,
        lower_start(role.start, context),
    )


def lower_environment(environment: Environment, context: Context) -> ir.Environment:
    """Lower an environment, lengths in metres."""
    world = next((item for item in environment.items if isinstance(item, World)), None)
    size = next((item for item in environment.items if isinstance(item, Size)), None)
    return replace(
        lower_geometry(environment, context),
        world=str(world.file) if world else None,
        size=_size(size) if size else None,
        doc=environment.doc,
        docs=lower_docs(environment.items),
        origin=environment.name.span,
    )


def _behavior(owner: Component | Member, context: Context) -> str | None:
    uses = all_items(owner, BehaviorUse)
    return context.name(uses[0].machine) if uses else None


def _communication(member: Member, context: Context) -> ir.CommunicationSettings | None:
    for settings in all_items(member, CommunicationSettings):
        return ir.CommunicationSettings(
            str(settings.technology),
            lower_values(settings.values, None, context),
            settings.doc,
            lower_docs(settings.values),
            settings.span,
        )
    return None


def _ports(items: Iterable[Port], context: Context) -> tuple[ir.Port, ...]:
    return tuple(
        ir.Port(
            str(item.name),
            item.direction,
            context.type_of(item.type),
            str(item.topic) if item.topic is not None else snake_case(item.name),
            item.doc,
            item.name.span,
        )
        for item in items
    )


def _part(part: Part, context: Context) -> ir.Part:
    return ir.Part(
        name=str(part.name),
        component=context.name(part.component),
        values=lower_values(part.values, part.component.target, context),
        operations=context.offered(part),
        doc=part.doc,
        docs=lower_docs(part.values),
        origin=part.name.span,
    )


def _port_groups(
    member: Member,
    ports: Iterable[ir.Port],
    connectors: tuple[ir.Connector, ...],
    context: Context,
) -> Iterator[ir.PortGroup]:
    """Yield the groups of connected ports, each with its topic."""
    if not connectors:
        return
    known: dict[PortKey, ir.Port] = {(None, port.name): port for port in ports}
    for part in all_items(member, Part):
        assert part.component.target is not None
        for port in _ports(all_items(part.component.target, Port), context):
            known[str(part.name), port.name] = port
    topics = {
        key: PortTopic(
            port.topic,
            key[0] is None or port.topic != snake_case(port.name),
            port.direction != "in",
        )
        for key, port in known.items()
    }
    joined = (
        ((each.source.part, each.source.port), (each.target.part, each.target.port))
        for each in connectors
    )
    for group in port_groups(topics, joined):
        yield ir.PortGroup(tuple(ir.PortRef(*key) for key in group.ports), group.topic)


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
