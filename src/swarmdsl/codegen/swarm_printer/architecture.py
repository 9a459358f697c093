"""Print components and members, without inherited items."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeVar

from swarmdsl.codegen.swarm_printer.contracts import print_contracts
from swarmdsl.codegen.swarm_printer.expressions import expression
from swarmdsl.codegen.swarm_printer.interfaces import on_topic, print_params
from swarmdsl.codegen.swarm_printer.layout import UnprintableError, block, documented, indented
from swarmdsl.codegen.swarm_printer.names import Names, operation_name, own_operations
from swarmdsl.codegen.swarm_printer.space import print_sights
from swarmdsl.ir import (
    Component,
    Connector,
    Docs,
    Expression,
    Member,
    Param,
    Part,
    Port,
    Service,
    Sight,
    System,
    doc_of,
)
from swarmdsl.ir.space import Values

T = TypeVar("T")


def print_component(component: Component, system: System, names: Names) -> list[str]:
    """Print a component with its operations."""
    base = system.components_by_name.get(component.base or "")
    return documented(
        component.doc,
        block(
            f"{component.kind} {component.name}{_extends(component)}",
            [
                *_behavior(component, base),
                *_ports(own(component.ports, base.ports if base else (), component), names),
                *print_params(own_params(component, base), names),
            ],
            print_sights(_own_sights(component, base)),
            [
                line
                for function in own_operations(component, system)
                for line in _operation(function, system, names)
            ],
        ),
    )


def print_member(member: Member, system: System, names: Names) -> list[str]:
    """Print a member with its parts, connectors and contracts."""
    base = system.members_by_name.get(member.base or "")
    return documented(
        member.doc,
        block(
            f"member {member.name}{_extends(member)}",
            [
                *_behavior(member, base),
                *_communication(member, base),
                *_equipment(member, base),
                *_ports(own(member.ports, base.ports if base else (), member), names),
                *print_params(own_params(member, base), names),
            ],
            [
                line
                for part in own(member.parts, base.parts if base else (), member)
                for line in _part(part)
            ],
            _connectors(own(member.connectors, base.connectors if base else (), member)),
            print_contracts(member, base),
        ),
    )


def own(items: Sequence[T], inherited: Sequence[T], owner: Component | Member) -> Sequence[T]:
    """Return the items after the inherited ones."""
    if items[: len(inherited)] != inherited:
        raise UnprintableError(f"`{owner.name}` lacks something of `{owner.base}`")
    return items[len(inherited) :]


def own_params(owner: Component | Member, base: Component | Member | None) -> list[Param]:
    """Return the params that are new, or replace an inherited one."""
    inherited = base.params if base is not None else ()
    names = [param.name for param in inherited]
    if [param.name for param in owner.params[: len(names)]] != names:
        raise UnprintableError(f"`{owner.name}` lacks a param of `{owner.base}`")
    return [param for param in owner.params if param not in inherited]


def _extends(owner: Component | Member) -> str:
    return f" extends {owner.base}" if owner.base is not None else ""


def _behavior(owner: Component | Member, base: Component | Member | None) -> list[str]:
    doc = doc_of(owner.docs, "behavior")
    inherited = (base.behavior, doc_of(base.docs, "behavior")) if base is not None else (None, "")
    if (owner.behavior, doc) == inherited:
        return []
    if owner.behavior is None:
        raise UnprintableError(f"`{owner.name}` lacks the behavior of `{owner.base}`")
    return documented(doc, [f"behavior {owner.behavior}"])


def _communication(member: Member, base: Member | None) -> list[str]:
    settings = member.communication
    if base is not None and settings == base.communication:
        return []
    if settings is None:
        if base is not None:
            raise UnprintableError(f"`{member.name}` lacks the communication of `{base.name}`")
        return []
    lines = block(
        f"communication {settings.technology}", print_values(settings.values, settings.docs)
    )
    return documented(settings.doc, lines)


def _equipment(member: Member, base: Member | None) -> list[str]:
    """Print the body, battery and radio of a member that are not inherited."""
    lines = []
    for kind in ("body", "battery", "radio"):
        values, docs = equipment(member, kind)
        if base is not None and (values, docs) == equipment(base, kind):
            continue
        if not values:
            if base is not None and equipment(base, kind)[0]:
                raise UnprintableError(f"`{member.name}` lacks the {kind} of `{base.name}`")
            continue
        inside = block(kind, print_values(values, docs))
        lines += documented(doc_of(docs, ""), inside)
    return lines


def equipment(member: Member, kind: str) -> tuple[Values, Docs]:
    """Return what a member is in space, of one kind, with the comments of the values by name.

    The comment of all of them has no name.
    """
    values: dict[str, Values] = {
        "body": member.body,
        "battery": member.battery,
        "radio": member.radio,
    }
    docs = ((name.partition("."), doc) for name, doc in member.docs)
    return values[kind], tuple((name, doc) for (head, _, name), doc in docs if head == kind)


def _own_sights(component: Component, base: Component | None) -> list[Sight]:
    """Return the sights that are new, or replace an inherited one."""
    inherited = base.sights if base is not None else ()
    kinds = [sight.kind for sight in inherited]
    if [sight.kind for sight in component.sights[: len(kinds)]] != kinds:
        raise UnprintableError(f"`{component.name}` lacks a sight of `{component.base}`")
    return [sight for sight in component.sights if sight not in inherited]


def print_values(values: Iterable[tuple[str, Expression]], docs: Docs) -> list[str]:
    """Print the values of a block, one on each line."""
    return [
        line
        for name, value in values
        for line in documented(doc_of(docs, name), [f"{name} = {expression(value)}"])
    ]


def _ports(ports: Iterable[Port], names: Names) -> list[str]:
    return [line for port in ports for line in documented(port.doc, [_port(port, names)])]


def _port(port: Port, names: Names) -> str:
    on = on_topic(port.topic, port.name)
    return f"{port.direction} {port.name} : {names.type(port.type)}{on}"


def _operation(function: str, system: System, names: Names) -> list[str]:
    offered = system.function(function)
    service = system.interface(offered.communication.type)
    assert isinstance(service, Service)
    head = f"operation {operation_name(offered)}"
    parameters = [
        (parameter.doc, f"{direction} {parameter.name} : {names.type(parameter.type)}")
        for direction, fields in (("in", service.request), ("out", service.response))
        for parameter in fields
    ]
    if not any(doc for doc, _ in parameters):
        lines = [f"{head}({', '.join(text for _, text in parameters)})"]
    else:
        last = len(parameters) - 1
        inside = [
            line
            for i, (doc, text) in enumerate(parameters)
            for line in documented(doc, [text if i == last else f"{text},"])
        ]
        lines = [f"{head}(", *indented(inside), ")"]
    return documented(offered.doc, lines)


def _part(part: Part) -> list[str]:
    head = f"{part.name} : {part.component}"
    values = print_values(part.values, part.docs)
    return documented(part.doc, block(head, values) if values else [head])


def _connectors(connectors: Iterable[Connector]) -> list[str]:
    return [
        line
        for each in connectors
        for line in documented(each.doc, [f"connect {each.source} -> {each.target}"])
    ]
