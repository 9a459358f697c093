"""ROS's default values, for data that a model leaves open."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

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


def default_value(type_: Type, system: System) -> Any:
    """Return the default as plain data; a message is a dictionary of its known fields."""
    match type_:
        case Primitive(name="string" | "wstring"):
            return ""
        case Primitive(name="bool"):
            return False
        case Primitive():
            return 0
        case Array(element=element, size=size, bounded=bounded):
            return [] if bounded else [default_value(element, system) for _ in range(size or 0)]
    return default_fields(_message_fields(type_, system), system)


def field_type(type_: Type | None, path: Iterable[str], system: System) -> Type | None:
    """Return the type at a path of fields in a value; None if it is not known."""
    for name in path:
        if not isinstance(type_, Named):
            return None
        types = {field.name: field.type for field in _message_fields(type_, system)}
        type_ = types.get(name)
    return type_


def sent_types(interface: Interface | None) -> dict[str, Type]:
    """Return the types of the fields of a goal or request, as far as they are known."""
    match interface:
        case Action(goal=fields) | Service(request=fields):
            return {field.name: field.type for field in fields}
    return {}


def result_fields(call: Communication, system: System) -> tuple[Field, ...] | None:
    """Return the fields of a function's result or response, or None if unknown."""
    match system.known_interface(call.type, Service):
        case Action(result=fields) | Service(response=fields):
            return fields
    return None


def default_result(call: Communication, system: System) -> dict[str, Any]:
    """Return the result of a function that succeeded.

    Field `success` of a response is true.
    """
    found = default_fields(result_fields(call, system) or (), system)
    if call.paradigm == "service" and found.get("success") is False:
        found["success"] = True
    return found


def default_fields(fields: Iterable[Field], system: System) -> dict[str, Any]:
    """Return the defaults of fields, by name."""
    return {field.name: default_value(field.type, system) for field in fields}


def _message_fields(type_: Named, system: System) -> tuple[Field, ...]:
    found = system.known_interface(type_)
    return found.fields if isinstance(found, Message) else ()
