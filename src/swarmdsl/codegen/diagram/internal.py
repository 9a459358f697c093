"""Internal block diagram of a member."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from swarmdsl import ir
from swarmdsl.codegen.diagram.graph import Diagram, Edge, Node, Port
from swarmdsl.codegen.diagram.labels import (
    equipment_groups,
    param_line,
    sight_line,
    type_name,
    value_lines,
)


def internal(member: ir.Member, components: Mapping[str, ir.Component]) -> Diagram:
    """Return the diagram of a member's parts; `components` are by name."""
    frame = Node(
        "",
        "frame",
        member.name,
        "member",
        _groups(
            [f"behavior {member.behavior}"] if member.behavior else [],
            map(param_line, member.params),
            *equipment_groups(member),
        ),
        tuple(_part(part, components[part.component]) for part in member.parts),
        _ports("", member.ports),
        member.doc,
        member.origin,
    )
    edges = tuple(_edge(number, each) for number, each in enumerate(member.connectors))
    return Diagram("internal", member.name, frame, edges)


def _part(part: ir.Part, component: ir.Component) -> Node:
    return Node(
        part.name,
        "part",
        f"{part.name} : {component.name}",
        component.kind,
        _groups(
            [f"behavior {component.behavior}"] if component.behavior else [],
            _params(part, component),
            map(sight_line, component.sights),
            (f"operation {name}" for name in part.operations or component.operations),
        ),
        ports=_ports(part.name, component.ports),
        doc=part.doc or component.doc,
        origin=part.origin,
    )


def _params(part: ir.Part, component: ir.Component) -> Iterable[str]:
    """Return the params of a part, with the values set there."""
    own = dict(part.values)
    for param in component.params:
        if param.name in own:
            yield from value_lines([(param.name, own[param.name])])
        else:
            yield param_line(param)


def _ports(owner: str, ports: Iterable[ir.Port]) -> tuple[Port, ...]:
    return tuple(
        Port(
            _port_id(owner, port.name),
            port.name,
            port.direction,
            type_name(port.type),
            "\n".join(filter(None, (f"{port.direction} {port.type} on {port.topic}", port.doc))),
            port.origin,
        )
        for port in ports
    )


def _port_id(owner: str, name: str) -> str:
    return f"{owner}:{name}"


def _edge(number: int, connector: ir.Connector) -> Edge:
    source, target = connector.source, connector.target
    return Edge(
        f"connector{number}",
        "connector",
        source.part or "",
        target.part or "",
        source_port=_port_id(source.part or "", source.port),
        target_port=_port_id(target.part or "", target.port),
        doc=connector.doc,
        origin=connector.origin,
    )


def _groups(*groups: Iterable[str]) -> tuple[tuple[str, ...], ...]:
    """Return the groups that are not empty."""
    return tuple(lines for group in groups if (lines := tuple(group)))
