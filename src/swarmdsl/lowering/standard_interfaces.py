"""Interfaces of ROS that a system uses without describing them."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

from swarmdsl import ir
from swarmdsl.analysis.resolve.type_names import written_type
from swarmdsl.analysis.types.constant_folding import Folding
from swarmdsl.base.records import replace
from swarmdsl.project.rosidl import standard
from swarmdsl.project.rosidl.interface_file import INTERFACE_KINDS, Interface
from swarmdsl.syntax.action_messages import generated_from
from swarmdsl.syntax.ast import ActionType, Constant, Field, MessageType, ServiceType


def with_standard_interfaces(system: ir.System) -> ir.System:
    """Return the system with the interfaces and packages of ROS that it mentions.

    The interfaces in their fields are included.
    """
    described = {each.type: each for each in system.interfaces}
    pending = list(_mentioned(system))
    seen: set[ir.Named] = set()
    found: dict[ir.Named, tuple[ir.Interface, ...]] = {}
    while pending:
        type_ = pending.pop()
        if type_ in seen:
            continue
        seen.add(type_)
        if type_ in described:
            continue
        found[type_] = _lowered(type_)
        for each in found[type_]:
            pending += _types_in(each)
        for generated in generated_from(type_):
            pending += (generated.action, *(inside for _, inside in generated.fields))
    known = set(standard.packages())
    return replace(
        system,
        standard=tuple(each for type_ in sorted(found, key=str) for each in found[type_]),
        ros_packages=tuple(sorted(known & {type_.package for type_ in seen})),
    )


def _mentioned(system: ir.System) -> Iterator[ir.Named]:
    """Yield the interfaces that declarations of a system name."""
    for interface in system.interfaces:
        yield from _types_in(interface)
    types: list[ir.Type] = [event.type for event in system.events]
    for function in system.functions:
        types += (function.communication.type, *(port.type for port in function.ports))
    params = [function.params for function in system.functions]
    owners: list[ir.Component | ir.Member] = [*system.components, *system.members]
    for owner in owners:
        types += [port.type for port in owner.ports]
        params.append(owner.params)
    for machine in system.machines:
        types += [variable.type for variable in machine.variables]
        params.append(machine.params)
    for fitness in system.fitness:
        types += [field.type for field in fitness.inputs]
        params.append(fitness.params)
    types += [param.type for each in params for param in each]
    for type_ in types:
        yield from _named(type_)


def _types_in(interface: ir.Interface) -> Iterator[ir.Named]:
    match interface:
        case ir.Message(fields=fields):
            pass
        case ir.Service():
            fields = (*interface.request, *interface.response)
        case ir.Action():
            fields = (*interface.goal, *interface.result, *interface.feedback)
    for field in fields:
        yield from _named(field.type)


def _named(type_: ir.Type) -> Iterator[ir.Named]:
    while isinstance(type_, ir.Array):
        type_ = type_.element
    if isinstance(type_, ir.Named):
        yield type_


@cache
def _lowered(type_: ir.Named) -> tuple[ir.Interface, ...]:
    """Return the message, service and action of that name that ROS has."""
    found = (standard.lookup(type_, kind) for kind in INTERFACE_KINDS)
    return tuple(_interface(type_, node) for node in found if node is not None)


def _interface(type_: ir.Named, node: Interface) -> ir.Interface:
    match node:
        case MessageType():
            constants = tuple(_constants(node.constants))
            return ir.Message(type_, _fields(node.fields), True, constants, node.doc)
        case ServiceType():
            request, response = _fields(node.request), _fields(node.response)
            return ir.Service(type_, request, response, True, node.doc)
        case ActionType():
            goal, result, feedback = map(_fields, (node.goal, node.result, node.feedback))
            return ir.Action(type_, goal, result, feedback, True, node.doc)


def _fields(nodes: list[Field]) -> tuple[ir.Field, ...]:
    types = [(node, written_type(node.type)) for node in nodes]
    return tuple(
        ir.Field(str(node.name), type_, node.doc) for node, type_ in types if type_ is not None
    )


def _constants(nodes: list[Constant]) -> Iterator[ir.Constant]:
    folding = Folding()
    for node in nodes:
        type_, value = written_type(node.type), folding.constant(node)
        if type_ is not None and value is not None:
            yield ir.Constant(str(node.name), type_, ir.Literal(value, type_), node.doc)
