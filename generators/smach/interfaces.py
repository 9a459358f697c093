"""The interfaces that the model itself defines, as .msg, .srv and .action files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.exchange.constants import constant
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
    System,
    Type,
)
from swarmdsl.python_source import comment_lines
from swarmdsl.source import Span

from .module import TARGET


def own_interfaces(system: System) -> list[Interface]:
    """The interfaces that are generated."""
    return [interface for interface in system.interfaces if not interface.external]


def file_name(interface: Interface) -> str:
    """The path of its file in its package."""
    folder = {Message: "msg", Service: "srv", Action: "action"}[type(interface)]
    return f"{folder}/{interface.type.name}.{folder}"


def definition(interface: Interface, report: Diagnostics) -> str:
    """The text of its file."""
    lines = _comments(interface.doc)
    if isinstance(interface, Message):
        for value in interface.constants:
            lines += [*_comments(value.doc), _constant(value, report)]
    for index, part in enumerate(parts(interface)):
        lines += ["---"] if index else []
        for field in part:
            lines += [*_comments(field.doc), *_field(field, interface.type.package, report)]
    return "".join(f"{line}\n" for line in lines)


def field_packages(interfaces: Iterable[Interface]) -> set[str]:
    """The packages whose messages are in the fields."""
    return {
        type_.package
        for interface in interfaces
        for part in parts(interface)
        for field in part
        for type_ in named(field.type)
    }


def parts(interface: Interface) -> tuple[tuple[Field, ...], ...]:
    """The fields of each part of an interface, in the order of its file."""
    match interface:
        case Message(fields=fields):
            return (fields,)
        case Service(request=request, response=response):
            return (request, response)
        case Action(goal=goal, result=result, feedback=feedback):
            return (goal, result, feedback)


def named(type_: Type) -> Iterator[Named]:
    """The message that is in a type, if there is one."""
    if isinstance(type_, Array):
        yield from named(type_.element)
    elif isinstance(type_, Named):
        yield type_


def _comments(text: str) -> list[str]:
    return [f"# {line}".rstrip() for line in comment_lines(text)]


def _constant(declared: Constant, report: Diagnostics) -> str:
    value = constant(declared.value, {})
    text = value if isinstance(value, str) else repr(value)
    if not isinstance(declared.type, Primitive) or declared.type.name in ("time", "duration"):
        _unsupported(f"a constant of type `{declared.type}`", declared.origin, report)
    elif value is None:
        _unsupported("a constant whose value is not known", declared.origin, report)
    elif text != text.strip() or not text.isprintable():
        # ROS takes all that stands in the line, without the blanks around it.
        _unsupported("a constant with blanks around it or line breaks", declared.origin, report)
    return f"{_type(declared.type, '', declared.origin, report)} {declared.name}={text}"


def _field(field: Field, package: str, report: Diagnostics) -> Iterator[str]:
    """The line of a field; ROS 1 has no bounds, so a comment says them."""
    if isinstance(field.type, Array) and isinstance(field.type.element, Array):
        _unsupported("an array of arrays in a message", field.origin, report)
        return
    element, size = field.type, ""
    if isinstance(field.type, Array):
        element = field.type.element
        size = "[]" if field.type.size is None or field.type.bounded else f"[{field.type.size}]"
        if field.type.bounded:
            yield f"# At most {field.type.size} elements."
    if isinstance(element, Primitive) and element.bound is not None:
        yield f"# At most {element.bound} characters."
    yield f"{_type(element, package, field.origin, report)}{size} {field.name}"


def _type(type_: Type, package: str, origin: Span | None, report: Diagnostics) -> str:
    if isinstance(type_, Primitive):
        if type_.name == "wstring":
            _unsupported("a `wstring`", origin, report)
        return type_.name
    if type_ == Named("std_msgs", "Header"):
        return str(type_)
    return type_.name if isinstance(type_, Named) and type_.package == package else str(type_)


def _unsupported(construct: str, origin: Span | None, report: Diagnostics) -> None:
    report.report("unsupported-construct", origin, target=TARGET, construct=construct)
