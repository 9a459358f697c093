"""Components, and members built from them."""

from __future__ import annotations

from swarmdsl.diagnostics import Label
from swarmdsl.inference import fits
from swarmdsl.scopes import bare, kind_of
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
    if component is None:
        return
    params = {str(item.name): item for item in component.items if isinstance(item, Param)}
    for value in part.values:
        param = params.get(str(value.name))
        if param is None:
            names = ", ".join(f"`{name}`" for name in params)
            context.report.report(
                "unknown-param",
                value.name.span,
                owner=f"{bare(kind_of(component))} `{component.name}`",
                name=value.name,
                help=f"it has {names}" if names else "it has no params",
            )
        else:
            context.expect(value.value, param.type.type, context.typing)


def _check_connector(connector: Connector, context: Context) -> None:
    source, target = connector.source.port.target, connector.target.port.target
    if source is None or target is None:
        return
    directed = _check_end(connector.source, source, "out", context)
    directed &= _check_end(connector.target, target, "in", context)
    if directed and not fits(source.type.type, target.type.type):
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


def _check_end(end: PortRef, port: Port, wanted: str, context: Context) -> bool:
    """Check that data leaves a part by `out` and enters it by `in`; return whether it does.

    For the member's own ports it is the other way round: they are seen from inside.
    """
    if end.part is None:
        wanted = {"in": "out", "out": "in"}[wanted]
    if port.direction in (wanted, "inout"):
        return True
    verb = "receives" if port.direction == "in" else "sends"
    where = "only" if end.part is not None else "only, seen from outside the member,"
    context.report.report(
        "port-direction",
        end.span,
        fault=f"`{end.span.text}` is an `{port.direction}` port: it {where} {verb}",
        related=(Label(port.name.span, "declared here"),),
        help="a connector leads from the sender to the receiver: `connect sender -> receiver`",
    )
    return False
