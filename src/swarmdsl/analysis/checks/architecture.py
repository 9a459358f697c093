"""Checks of components and members."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.analysis.checks.connectors import check_connectors
from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.interfaces import check_graph_name
from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.analysis.resolve.inheritance import MOST_BASES, all_items
from swarmdsl.analysis.types import check_types, fits
from swarmdsl.base.diagnostics.advice import insert
from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.graphs import cycles, leaves_first
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import suggest
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    BehaviorUse,
    CommunicationSettings,
    Component,
    Member,
    Param,
    Part,
    Port,
)
from swarmdsl.syntax.types import INT, STRING

# Settings of the communication between members.
_SETTINGS = ("ifname", "port", "name", "device_class")


def check_component(component: Component, context: Context) -> None:
    """Check the base, the params and the behaviour of a component."""
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
    """Check that the topics of ports have valid ROS names."""
    for item in owner.items:
        if isinstance(item, Port) and item.topic is not None:
            check_graph_name(item.topic, "a topic", context)


def check_inheritance(project: Project, context: Context) -> None:
    """Check for cycles of inheritance and for its depth."""
    owners = [o for _, o in project.declarations() if isinstance(o, (Component, Member))]

    def bases(owner: Component | Member) -> Iterator[tuple[Span, Component | Member]]:
        if owner.base is not None and owner.base.target is not None:
            yield owner.base.span, owner.base.target

    has_cycles = False
    for owner, spans in cycles(owners, bases):
        has_cycles = True
        *earlier, last = spans
        context.report.report(
            "inheritance-cycle",
            last,
            name=owner.name,
            related=tuple(Label(span, "through this") for span in earlier),
        )
    if not has_cycles:
        _check_depth(owners, context.report)


def _check_depth(owners: list[Component | Member], report: Diagnostics) -> None:
    """Check the depth of inheritance; report the first owner that is too deep."""
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
    check_connectors(member, context)
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
        expected = INT if value.name == "port" else STRING
        context.expect(value.value, expected, context.typing)


def _check_params_given(owner: Component | Member, use: BehaviorUse, context: Context) -> None:
    """Check that each param of a machine has a default or a param of its name in the owner."""
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
                help=insert(
                    f"param {param.name} : {param.type.span.text}",
                    owner.name.span,
                    to=f"`{owner.name}`",
                ),
            )
        elif given is not None and not fits(given.type.type, param.type.type):
            context.report.report(
                "type-mismatch",
                given.type.span,
                expected=f"`{param.type.type}`",
                found=f"`{given.type.type}`",
                related=(Label(param.type.span, "the behavior declares it so"),),
            )
        elif given is not None:
            check_types(given.type.type, param.type.type, given.type.span, context.report)


def _check_part(part: Part, context: Context) -> None:
    context.check_repeated((value.name for value in part.values), "param")
    component = part.component.target
    if component is None or component in context.incomplete:
        return
    params = {str(param.name): param for param in all_items(component, Param)}
    for value in part.values:
        param = params.get(str(value.name))
        if param is None:
            context.report_unknown_param(
                value.name, f"{kind_name(component)} `{component.name}`", params
            )
        else:
            context.expect(value.value, param.type.type, context.typing)
