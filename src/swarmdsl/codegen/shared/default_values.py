"""The value of what the model gives none: ROS's default for its type."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from swarmdsl.analysis.interfaces import Interfaces
from swarmdsl.ir import (
    Action,
    Array,
    Communication,
    Field,
    Interface,
    Message,
    Named,
    Primitive,
    Service,
    System,
    Type,
)
from swarmdsl.syntax.ast import ActionType, ServiceType


def default_value(type_: Type, system: System) -> Any:
    """The default as plain data; a message is a dictionary of its fields, as far as known."""
    match type_:
        case Primitive(name="string" | "wstring"):
            return ""
        case Primitive(name="bool"):
            return False
        case Primitive():
            return 0
        case Array(element=element, size=size, bounded=bounded):
            return [] if bounded else [default_value(element, system) for _ in range(size or 0)]
        case Named() if system.interface(type_) is None:
            # What ROS itself comes with is described nowhere in the model.
            fields = Interfaces(()).fields(type_) or ()
            return {
                str(field.name): default_value(field.type.type, system)
                for field in fields
                if field.type.type is not None
            }
    described = system.interface(type_)
    return default_fields(described.fields, system) if isinstance(described, Message) else {}


def field_type(type_: Type | None, path: Iterable[str], system: System) -> Type | None:
    """The type of what lies at a path in a value; None where nothing is known of it."""
    for name in path:
        if not isinstance(type_, Named):
            return None
        described = system.interface(type_)
        if isinstance(described, Message):
            types = {field.name: field.type for field in described.fields}
        else:
            known = Interfaces(()).fields(type_) or ()
            types = {str(field.name): field.type.type for field in known if field.type.type}
        type_ = types.get(name)
    return type_


def sent_types(interface: Interface | None) -> dict[str, Type]:
    """The types of the fields of a goal or request, as far as they are known."""
    match interface:
        case Action(goal=fields) | Service(request=fields):
            return {field.name: field.type for field in fields}
    return {}


def result_fields(call: Communication, system: System) -> tuple[Field, ...] | None:
    """The fields of what a function gives, its result or response; None where they are unknown."""
    described = system.interface(call.type) or Interfaces(()).standard(call.type, ServiceType)
    match described:
        case Action(result=fields) | Service(response=fields):
            return fields
        case ActionType(result=nodes) | ServiceType(response=nodes):
            types = [(str(node.name), node.type.type) for node in nodes]
            return tuple(Field(name, type_) for name, type_ in types if type_ is not None)
    return None


def default_result(call: Communication, system: System) -> dict[str, Any]:
    """What a function gives that has succeeded: a service may have a field that says so."""
    found = default_fields(result_fields(call, system) or (), system)
    if call.paradigm == "service" and found.get("success") is False:
        found["success"] = True
    return found


def default_fields(fields: Iterable[Field], system: System) -> dict[str, Any]:
    """The defaults of some fields, by name."""
    return {field.name: default_value(field.type, system) for field in fields}
