"""Components, and members built from them."""

from __future__ import annotations

from swarmdsl.diagnostics import Label
from swarmdsl.inference import fits
from swarmdsl.scopes import bare, kind_of
from swarmdsl.suggest import suggest
from swarmdsl.syntax import (
    BehaviorUse,
    Component,
    Connector,
    Member,
    Param,
    Part,
    Port,
    PortRef,
)
from swarmdsl.validate.context import Context


def check_component(component: Component, context: Context) -> None:
    """Check the ports and params of a component."""
    for item in component.items:
        if isinstance(item, Param):
            context.check_default(item, item.default)


def check_member(member: Member, context: Context) -> None:
    """Check behaviour, params, parts and connectors of a member."""
    behaviors = [item for item in member.items if isinstance(item, BehaviorUse)]
    context.check_single([item.span for item in behaviors], "the behavior")
    for item in member.items:
        match item:
            case BehaviorUse():
                _check_params_given(member, item, context)
            case Param():
                context.check_default(item, item.default)
            case Part():
                _check_part(item, context)
            case Connector():
                _check_connector(item, context)


def _check_params_given(member: Member, use: BehaviorUse, context: Context) -> None:
    """A param of the machine needs a default, or a param of the same name in the member."""
    machine = use.machine.target
    own = {str(item.name): item for item in member.items if isinstance(item, Param)}
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
                help=f"add `param {param.name} : {param.type.span.text}` to the member",
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
    params = {str(item.name): item for item in component.items if isinstance(item, Param)}
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
    if not fits(source.type.type, target.type.type):
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
