"""Components, and members built from them."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.diagnostics import Diagnostics, Label
from swarmdsl.graph import cycles, leaves_first
from swarmdsl.inference import fits
from swarmdsl.inheritance import MOST_BASES, all_items
from swarmdsl.ir.types import INT, STRING
from swarmdsl.load import Project
from swarmdsl.scopes import bare, kind_of
from swarmdsl.source import Span
from swarmdsl.suggest import suggest
from swarmdsl.syntax import (
    BehaviorUse,
    CommunicationSettings,
    Component,
    Connector,
    Member,
    Param,
    Part,
    Port,
    PortRef,
)
from swarmdsl.validate.context import Context
from swarmdsl.validate.interfaces import check_graph_name

# What can be said of the technology that members reach each other with.
_SETTINGS = ("ifname", "port", "name", "device_class")


def check_component(component: Component, context: Context) -> None:
    """Check what a component extends, its params and its behaviour."""
    base = component.base.target if component.base is not None else None
    if base is not None and base.kind != component.kind and component.base is not None:
        context.report.report(
            "wrong-kind",
            component.base.span,
            name=base.name,
            actual=f"a {base.kind}".replace("a actuator", "an actuator"),
            expected=f"a {component.kind}".replace("a actuator", "an actuator"),
            related=(Label(base.name.span, "declared here"),),
        )
    check_ports(component, context)
    behaviors = [item for item in component.items if isinstance(item, BehaviorUse)]
    context.check_single([item.span for item in behaviors], "the behavior")
    for item in component.items:
        match item:
            case Param():
                context.check_default(item, item.default)
            case BehaviorUse():
                _check_params_given(component, item, context)


def check_ports(owner: Component | Member, context: Context) -> None:
    """The topic behind a port has a name that ROS takes."""
    for item in owner.items:
        if isinstance(item, Port) and item.topic is not None:
            check_graph_name(item.topic, "a topic", context)


def check_inheritance(project: Project, report: Diagnostics) -> None:
    """No component and no member extends itself, through however many others, or very many."""
    owners = [o for _, o in project.declarations() if isinstance(o, (Component, Member))]

    def bases(owner: Component | Member) -> Iterator[tuple[Span, Component | Member]]:
        if owner.base is not None and owner.base.target is not None:
            yield owner.base.span, owner.base.target

    endless = False
    for owner, spans in cycles(owners, bases):
        endless = True
        *way, last = spans
        report.report(
            "inheritance-cycle",
            last,
            name=owner.name,
            related=tuple(Label(span, "by way of this") for span in way),
        )
    if not endless:
        _check_depth(owners, report)


def _check_depth(owners: list[Component | Member], report: Diagnostics) -> None:
    """Check how many others are extended in turn; the first one that is too far is reported."""
    depth: dict[Component | Member | None, int] = {None: -1}
    for owner in leaves_first(owners, lambda o: [b for b in [_base(o)] if b is not None]):
        depth[owner] = depth[_base(owner)] + 1
        if depth[owner] == MOST_BASES + 1 and owner.base is not None:
            report.report("nested-too-deeply", owner.base.span, limit=MOST_BASES)


def _base(owner: Component | Member) -> Component | Member | None:
    return owner.base.target if owner.base is not None else None


def check_member(member: Member, context: Context) -> None:
    """Check behaviour, params, parts and connectors of a member."""
    behaviors = [item for item in member.items if isinstance(item, BehaviorUse)]
    context.check_single([item.span for item in behaviors], "the behavior")
    check_ports(member, context)
    settings = [item for item in member.items if isinstance(item, CommunicationSettings)]
    context.check_single([item.span for item in settings], "the communication")
    _check_connected(member, context)
    _check_driven_once(member, context)
    for use in all_items(member, BehaviorUse):
        _check_params_given(member, use, context)
    for item in member.items:
        match item:
            case CommunicationSettings():
                _check_settings(item, context)
            case Param():
                context.check_default(item, item.default)
            case Part():
                _check_part(item, context)
            case Connector():
                _check_connector(item, context)


def _check_connected(member: Member, context: Context) -> None:
    """Check that something is connected to each `in` port of a part without a topic of its own."""
    connectors = all_items(member, Connector)
    # Either end: a connector that is the wrong way round is reported as such.
    ends = [end for connector in connectors for end in (connector.source, connector.target)]
    connected = {(end.part.target, end.port.target) for end in ends if end.part is not None}
    # Of two with one name, which are reported, connectors lead to the first.
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
                    help=f"add `connect ... -> {part.name}.{port.name}`, or give the port a topic",
                )


def _check_driven_once(member: Member, context: Context) -> None:
    """Check that no port gets its data from two connectors, and no connector is there twice."""
    first: dict[tuple[Part | None, Port], dict[tuple[Part | None, Port], Connector]] = {}
    for connector in all_items(member, Connector):
        end, source = connector.target, connector.source.port.target
        if source is None or end.port.target is None:
            continue
        if "start" not in _places(connector.source, source) or "end" not in _places(
            end, end.port.target
        ):
            continue  # leads the wrong way, which is reported
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
                help="what comes from two sides mixes on one topic: give each a port of its own",
            )


def _check_settings(settings: CommunicationSettings, context: Context) -> None:
    context.check_repeated((value.name for value in settings.values), "setting")
    for value in settings.values:
        if value.name not in _SETTINGS:
            context.report.report(
                "unknown-setting",
                value.name.span,
                name=value.name,
                help=suggest(value.name, _SETTINGS, "settings"),
            )
            continue
        wanted = INT if value.name == "port" else STRING
        context.expect(value.value, wanted, context.typing)


def _check_params_given(owner: Component | Member, use: BehaviorUse, context: Context) -> None:
    """A param of the machine needs a default, or a param of the same name in its owner."""
    machine = use.machine.target
    own = {str(param.name): param for param in all_items(owner, Param)}
    for param in machine.items if machine else ():
        if not isinstance(param, Param):
            continue
        given = own.get(str(param.name))
        if given is None and param.default is None:
            context.report.report(
                "missing-value",
                use.machine.span,
                name=param.name,
                machine=use.machine.name,
                related=(Label(param.name.span, "declared here, without a default"),),
                help=f"add `param {param.name} : {param.type.span.text}` to `{owner.name}`",
            )
        elif given is not None and not fits(given.type.type, param.type.type):
            context.report.report(
                "type-mismatch",
                given.type.span,
                expected=f"`{param.type.type}`",
                found=f"`{given.type.type}`",
                related=(Label(param.type.span, "the behavior declares it so"),),
            )


def _check_part(part: Part, context: Context) -> None:
    context.check_repeated((value.name for value in part.values), "param")
    component = part.component.target
    if component is None or component in context.damaged:
        return
    params = {str(param.name): param for param in all_items(component, Param)}
    for value in part.values:
        param = params.get(str(value.name))
        if param is None:
            context.report.report(
                "unknown-param",
                value.name.span,
                owner=f"{bare(kind_of(component))} `{component.name}`",
                name=value.name,
                help=suggest(value.name, params, "params"),
            )
        else:
            context.expect(value.value, param.type.type, context.typing)


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
            help="name another port, or remove the connector",
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
        )


def _check_direction(connector: Connector, source: Port, target: Port, context: Context) -> bool:
    """Check that a connector leads from a sender to a receiver; return whether it does."""
    ends = ((connector.source, source, "start"), (connector.target, target, "end"))
    wrong = [(end, port) for end, port, place in ends if place not in _places(end, port)]
    if len(wrong) == 2:
        context.report.report(
            "port-direction",
            connector.span,
            fault="this connector leads from the receiver to the sender",
            related=tuple(Label(port.name.span, _as_declared(end, port)) for end, port in wrong),
            help=f"write `connect {connector.target.span.text} -> {connector.source.span.text}`",
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
    """Where in a connector a port may stand; the member's own ports are seen from inside."""
    if port.direction == "inout":
        return ("start", "end")
    return ("start",) if (port.direction == "out") == (end.part is not None) else ("end",)


def _as_declared(end: PortRef, port: Port) -> str:
    if end.part is not None:
        return f"`{end.span.text}` is an `{port.direction}` port"
    way = "enters" if port.direction == "in" else "leaves"
    return f"by `{port.direction}` port `{end.span.text}` data {way} the member"
