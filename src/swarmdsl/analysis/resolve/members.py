"""Resolve the ends of connectors of members, and the states of their contracts."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache

from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.analysis.resolve.inheritance import all_items, by_name
from swarmdsl.analysis.resolve.properties import link_safe_states
from swarmdsl.analysis.resolve.report_unresolved import report_missing_inside, report_part_as_port
from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.syntax.ast import Component, Connector, Contract, Member, Part, Port, PortRef


def link_member(member: Member, scope: FileScope, report: Diagnostics) -> None:
    """Resolve the two ends of each connector, and the states of contracts."""
    parts = by_name(all_items(member, Part), Part)
    ports = cache(_ports)
    for item in member.items:
        if isinstance(item, Contract):
            link_safe_states(item, member, scope, report)
        if isinstance(item, Connector):
            for end in (item.source, item.target):
                _link_port(end, member, parts, ports, scope, report)


def _link_port(
    end: PortRef,
    member: Member,
    parts: Mapping[str, Part],
    ports: Callable[[Component | Member], Mapping[str, Port]],
    scope: FileScope,
    report: Diagnostics,
) -> None:
    if end.part is None:
        name, own = end.port.name, ports(member)
        end.port.target = own.get(name)
        kind = f"port of member `{member.name}`"
        if end.port.target is None and name in parts:
            report_part_as_port(end.port, kind, report)
        elif end.port.target is None:
            report_missing_inside(kind, name, end.port.span, own, scope, report)
        return
    end.part.target = parts.get(end.part.name)
    if end.part.target is None:
        report_missing_inside("part", end.part.name, end.part.span, parts, scope, report)
        return
    component = end.part.target.component.target
    if component is None:
        return
    known = ports(component)
    end.port.target = known.get(end.port.name)
    if end.port.target is None:
        kind = f"port of {kind_name(component)} `{component.name}`"
        report_missing_inside(kind, end.port.name, end.port.span, known, scope, report)


def _ports(owner: Component | Member) -> dict[str, Port]:
    return by_name(all_items(owner, Port), Port)
