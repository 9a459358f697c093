"""Checks of connectors: direction, types, topics and unconnected ports."""

from __future__ import annotations

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.port_groups import PortGroup, PortKey, PortTopic, port_groups
from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.types import fits
from swarmdsl.base.diagnostics.advice import Advice, behind, edits, write
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.naming import snake_case
from swarmdsl.syntax.ast import Connector, Member, Part, Port, PortRef


def check_connectors(member: Member, context: Context) -> None:
    """Check the connectors of a member and its unconnected ports."""
    connectors = all_items(member, Connector)
    _check_connected(member, connectors, context)
    _check_driven_once(connectors, context)
    _check_topics(member, connectors, context)
    for item in member.items:
        if isinstance(item, Connector):
            _check_connector(item, context)


def _check_connected(member: Member, connectors: list[Connector], context: Context) -> None:
    """Check that each `in` port of a part without a topic of its own is connected."""
    # Both ends count: a reversed connector is reported elsewhere.
    ends = [end for connector in connectors for end in (connector.source, connector.target)]
    connected = {(end.part.target, end.port.target) for end in ends if end.part is not None}
    # Connectors lead to the first part of a repeated name.
    parts = {str(part.name): part for part in reversed(all_items(member, Part))}
    own = {item for item in member.items if isinstance(item, Part)}
    for part in parts.values():
        if part not in own or part.component.target is None:
            continue
        ports = {str(port.name): port for port in reversed(all_items(part.component.target, Port))}
        for port in ports.values():
            if port.direction == "in" and port.topic is None and (part, port) not in connected:
                context.report.report(
                    "unconnected-port",
                    part.name.span,
                    port=f"{part.name}.{port.name}",
                    related=(Label(port.name.span, "declared here"),),
                    help=edits(
                        f"add `connect ... -> {part.name}.{port.name}`, or give the port a topic",
                        f'Add `on "{port.name}"` to the port',
                        behind(port.span, f' on "{port.name}"'),
                    ),
                )


def _check_driven_once(connectors: list[Connector], context: Context) -> None:
    """Check that no port has two incoming connectors and no connector is repeated."""
    first: dict[tuple[Part | None, Port], dict[tuple[Part | None, Port], Connector]] = {}
    for connector in connectors:
        end, source = connector.target, connector.source.port.target
        if source is None or end.port.target is None:
            continue
        if "start" not in _places(connector.source, source) or "end" not in _places(
            end, end.port.target
        ):
            continue  # a reversed connector, reported elsewhere
        ends = [
            (each.part.target if each.part is not None else None, port)
            for each, port in ((connector.source, source), (end, end.port.target))
        ]
        by_source = first.setdefault(ends[1], {})
        same = by_source.get(ends[0])
        others = list(by_source.values())
        by_source.setdefault(ends[0], connector)
        if same is not None:
            context.report.report(
                "repeated-item",
                connector.span,
                item="this connector",
                related=(Label(same.span, "first given here"),),
            )
        elif others:
            context.report.report(
                "driven-twice",
                end.span,
                port=end.span.text,
                related=(Label(others[0].span, "already connected here"),),
                help="data of two connectors mix on one topic: give each a port of its own",
            )


def _check_topics(member: Member, connectors: list[Connector], context: Context) -> None:
    """Check that connected ports agree on their topic and unconnected ones do not share it.

    The topic of a port of the member itself has precedence over those of its parts.
    """
    declared: dict[PortKey, Port] = {(None, str(p.name)): p for p in all_items(member, Port)}
    for part in all_items(member, Part):
        if part.component.target is not None:
            ports = all_items(part.component.target, Port)
            declared.update(((str(part.name), str(port.name)), port) for port in ports)
    topics = {key: _topic(key, port) for key, port in declared.items()}
    ends = [(connector.source, connector.target) for connector in connectors]
    at = {_key(end): end for both in reversed(ends) for end in both}
    first: dict[str, PortGroup] = {}
    for group in port_groups(topics, ((_key(source), _key(target)) for source, target in ends)):
        other = first.setdefault(group.topic, group)
        if other is not group:
            context.report.report(
                "shared-topic",
                at[group.ports[0]].span,
                topic=group.topic,
                related=(Label(at[other.ports[0]].span, "the other one is here"),),
                help="each receives the data of the other: give the ports different topics",
            )
        if group.ports[0][0] is None:
            continue
        for key in group.ports:
            if topics[key].given and topics[key].topic != group.topic:
                context.report.report(
                    "replaced-topic",
                    at[key].span,
                    port=at[key].span.text,
                    topic=group.topic,
                    own=topics[key].topic,
                    related=(Label(declared[key].name.span, "declared here"),),
                    help=_leave_out_topic(declared[key]),
                )


def _leave_out_topic(port: Port) -> str:
    """Return the help for a port whose topic is not used."""
    text = (
        "connected ports share one topic: give it at one of the ports, or at a port of the member"
    )
    type_, topic = port.type.span, port.topic
    if topic is None:
        return text
    place = type_._replace(start=type_.end, end=topic.span.end)
    return edits(text, f"Remove `on {topic.span.text}`", (place, ""))


def _topic(key: PortKey, port: Port) -> PortTopic:
    name = snake_case(port.name)
    topic = str(port.topic) if port.topic is not None else name
    return PortTopic(topic, key[0] is None or topic != name, port.direction != "in")


def _key(end: PortRef) -> PortKey:
    return end.part.name if end.part is not None else None, end.port.name


def _check_connector(connector: Connector, context: Context) -> None:
    source, target = connector.source.port.target, connector.target.port.target
    if source is None or target is None:
        return
    if not _check_direction(connector, source, target, context):
        return
    if source is target and connector.source.span.text == connector.target.span.text:
        context.report.report(
            "port-direction",
            connector.span,
            fault=f"this connector leads from `{connector.source.span.text}` back to itself",
            help=Advice("name another port, or remove the connector", "remove connector"),
        )
    elif not fits(source.type.type, target.type.type):
        context.report.report(
            "port-type-mismatch",
            connector.span,
            source=connector.source.span.text,
            target=connector.target.span.text,
            sent=f"`{source.type.type}`",
            taken=f"`{target.type.type}`",
            related=(
                Label(source.type.span, f"`{connector.source.span.text}` is declared here"),
                Label(target.type.span, f"`{connector.target.span.text}` is declared here"),
            ),
            help="give both ports one type, or put a component between them that converts",
        )


def _check_direction(connector: Connector, source: Port, target: Port, context: Context) -> bool:
    """Check that a connector leads from a sender to a receiver; return True if it does."""
    ends = ((connector.source, source, "start"), (connector.target, target, "end"))
    wrong = [(end, port) for end, port, place in ends if place not in _places(end, port)]
    if len(wrong) == 2:
        context.report.report(
            "port-direction",
            connector.span,
            fault="this connector leads from the receiver to the sender",
            related=tuple(Label(port.name.span, _as_declared(end, port)) for end, port in wrong),
            help=write(f"connect {connector.target.span.text} -> {connector.source.span.text}"),
        )
        return False
    for end, port in wrong:
        context.report.report(
            "port-direction",
            end.span,
            fault=f"a connector cannot {'end' if end is connector.target else 'start'} here: "
            + _as_declared(end, port),
            related=(Label(port.name.span, "declared here"),),
        )
    return not wrong


def _places(end: PortRef, port: Port) -> tuple[str, ...]:
    """Return the ends of a connector that a port may be.

    Ports of the member itself have the direction of their inner side.
    """
    if port.direction == "inout":
        return ("start", "end")
    return ("start",) if (port.direction == "out") == (end.part is not None) else ("end",)


def _as_declared(end: PortRef, port: Port) -> str:
    if end.part is not None:
        return f"`{end.span.text}` is an `{port.direction}` port"
    way = "enters" if port.direction == "in" else "leaves"
    return f"by `{port.direction}` port `{end.span.text}` data {way} the member"
