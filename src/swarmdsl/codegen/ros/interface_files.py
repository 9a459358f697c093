"""Interfaces as .msg, .srv and .action files of ROS 1 or ROS 2.

ROS 1: https://wiki.ros.org/msg; ROS 2: https://docs.ros.org, "Interfaces".
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from typing import Literal

from swarmdsl.base.source import Span
from swarmdsl.codegen.python import comment_lines
from swarmdsl.codegen.shared.constants import constant
from swarmdsl.ir import (
    Action,
    Array,
    Constant,
    Field,
    Interface,
    Message,
    Named,
    Primitive,
    Service,
    Type,
)
from swarmdsl.syntax.types import declared_unit
from swarmdsl.syntax.units import described_unit

Generation = Literal[1, 2]
Complain = Callable[[str, Span | None], None]
"""Called with a construct that ROS lacks, and its origin."""

FOLDERS = {Message: "msg", Service: "srv", Action: "action"}
TIMES = {"time": "builtin_interfaces/Time", "duration": "builtin_interfaces/Duration"}

_INTERFACE = r"[A-Z][A-Za-z0-9]*"
_INTERFACE_HINT = "a ROS interface starts with a capital letter and has letters and digits only"
_FIELD = {1: r"[A-Za-z][A-Za-z0-9_]*", 2: r"[a-z](_?[a-z0-9])*"}
_FIELD_HINT = {
    1: "ROS requires letters, digits and `_`, and a letter first",
    2: "ROS 2 requires lower-case letters, digits and single `_`",
}
_CONSTANT = {1: _FIELD[1], 2: r"[A-Z](_?[A-Z0-9])*"}
_CONSTANT_HINT = {1: _FIELD_HINT[1], 2: "ROS 2 requires capital letters, digits and single `_`"}


def interface_path(interface: Interface) -> str:
    """Return the path of the interface's file in its package."""
    folder = FOLDERS[type(interface)]
    return f"{folder}/{interface.type.name}.{folder}"


def interface_parts(interface: Interface) -> tuple[tuple[Field, ...], ...]:
    """Return the fields of each part of an interface, in the order of its file."""
    match interface:
        case Message(fields=fields):
            return (fields,)
        case Service(request=request, response=response):
            return (request, response)
        case Action(goal=goal, result=result, feedback=feedback):
            return (goal, result, feedback)


def named_types(type_: Type) -> Iterator[Named]:
    """Yield the message type in a type, if there is one."""
    if isinstance(type_, Array):
        yield from named_types(type_.element)
    elif isinstance(type_, Named):
        yield type_


def invalid_names(
    interface: Interface, ros: Generation
) -> Iterator[tuple[str, str, str, Span | None]]:
    """Yield names that ROS rejects: name, use, hint, origin."""
    if not re.fullmatch(_INTERFACE, interface.type.name):
        use = "the name of an interface"
        yield interface.type.name, use, _INTERFACE_HINT, interface.origin
    for value in interface.constants if isinstance(interface, Message) else ():
        if not re.fullmatch(_CONSTANT[ros], value.name):
            yield value.name, "the name of a constant", _CONSTANT_HINT[ros], value.origin
    for field in (field for part in interface_parts(interface) for field in part):
        if not re.fullmatch(_FIELD[ros], field.name):
            yield field.name, "the name of a field", _FIELD_HINT[ros], field.origin


def depends(interfaces: Iterable[Interface], ros: Generation) -> set[str]:
    """Return the packages of field types, and those that every action needs."""
    found: set[str] = set()
    for interface in interfaces:
        for field in (field for part in interface_parts(interface) for field in part):
            element = field.type.element if isinstance(field.type, Array) else field.type
            if isinstance(element, Named):
                found.add(element.package)
            elif ros == 2 and isinstance(element, Primitive) and element.name in TIMES:
                found.add("builtin_interfaces")
        if isinstance(interface, Action):
            found.add("actionlib_msgs" if ros == 1 else "action_msgs")
    return found


def definition(interface: Interface, ros: Generation, complain: Complain) -> str:
    """Return the text of the interface's file."""
    lines = _comments(interface.doc)
    if isinstance(interface, Message):
        for value in interface.constants:
            lines += [*_comments(value.doc), _constant(value, ros, complain)]
    for index, part in enumerate(interface_parts(interface)):
        lines += ["---"] if index else []
        for field in part:
            lines += _comments(field.doc)
            lines += _field(field, interface.type.package, ros, complain)
    return "".join(f"{line}\n" for line in lines)


def _comments(text: str) -> list[str]:
    """Return comments without backslashes: generators of ROS put them unescaped into code."""
    plain = text.replace("\\", "\N{SET MINUS}")
    return [f"# {line}".rstrip() for line in comment_lines(plain)]


def _constant(declared: Constant, ros: Generation, complain: Complain) -> str:
    value = constant(declared.value, {})
    if not isinstance(declared.type, Primitive) or declared.type.name in TIMES:
        complain(f"a constant of type `{declared.type}`", declared.origin)
    elif value is None:
        complain("a constant whose value is not known", declared.origin)
    text = value if isinstance(value, str) else repr(value)
    if isinstance(value, str) and ros == 2:
        text = '"' + value.replace('"', '\\"') + '"'
    elif isinstance(value, bool) and ros == 2:
        text = str(value).lower()
    if isinstance(value, str):
        for fault in _text_faults(value, ros):
            complain(f"a constant with {fault}", declared.origin)
    return f"{_type(declared.type, '', ros, declared.origin, complain)} {declared.name}={text}"


def _text_faults(text: str, ros: Generation) -> Iterator[str]:
    """Yield what a string constant contains that the tools of ROS change or fail at."""
    if not text.isprintable():
        yield "line breaks or invisible characters"  # the value ends with the line
    elif ros == 1 and text != text.strip():
        yield "blanks around it"
    if "\\" in text:
        yield "a backslash"  # which generators of code do not escape
    if ros == 2 and "#" in text:
        yield "a `#`"  # begins a comment, in quotes too


def _field(field: Field, package: str, ros: Generation, complain: Complain) -> Iterator[str]:
    """Yield the line of a field; in ROS 1, comments give the bounds."""
    element, size = field.type, ""
    if isinstance(field.type, Array):
        element = field.type.element
        if isinstance(element, Array):
            complain("an array of arrays in a message", field.origin)
            return
        size = "" if field.type.size is None else str(field.type.size)
        if field.type.bounded and ros == 1:
            yield f"# At most {size} elements."
            size = ""
        size = f"[{'<=' if field.type.bounded and ros == 2 else ''}{size}]"
    if isinstance(element, Primitive) and element.bound is not None and ros == 1:
        yield f"# At most {element.bound} characters."
    unit = declared_unit(field.type)
    if unit is not None:
        yield f"# {described_unit(unit)}"
    yield f"{_type(element, package, ros, field.origin, complain)}{size} {field.name}"


def _type(
    type_: Type, package: str, ros: Generation, origin: Span | None, complain: Complain
) -> str:
    if isinstance(type_, Primitive):
        if ros == 2:
            return TIMES.get(type_.name, str(type_))
        if type_.name == "wstring":
            complain("a `wstring`", origin)
        return type_.name
    return type_.name if isinstance(type_, Named) and type_.package == package else str(type_)
