"""The interfaces that the model itself defines, as .msg, .srv and .action files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.ir import Action, Array, Field, Interface, Message, Named, Service, System, Type

from .imports import RosTypes
from .module import TARGET
from .python import comment_lines


def own_interfaces(system: System) -> list[Interface]:
    """The interfaces that the generated package defines."""
    return [interface for interface in system.interfaces if not interface.external]


def file_name(interface: Interface) -> str:
    """The path of its file in the package."""
    folder = {Message: "msg", Service: "srv", Action: "action"}[type(interface)]
    return f"{folder}/{interface.type.name}.{folder}"


def definition(interface: Interface, types: RosTypes, report: Diagnostics) -> str:
    """The text of its file."""
    lines = [f"# {line}".rstrip() for line in comment_lines(interface.doc)]
    for index, part in enumerate(_parts(interface)):
        lines += ["---"] if index else []
        for field in part:
            lines += [f"# {line}".rstrip() for line in comment_lines(field.doc)]
            lines.append(f"{_type(field, types, report)} {field.name}")
    return "".join(f"{line}\n" for line in lines)


def field_packages(interfaces: Iterable[Interface], types: RosTypes) -> list[str]:
    """The other packages whose messages are in the fields."""
    found = {
        types.ros_package(type_)
        for interface in interfaces
        for part in _parts(interface)
        for field in part
        for type_ in _named(field.type)
    }
    return sorted(found - {types.package})


def _parts(interface: Interface) -> tuple[tuple[Field, ...], ...]:
    match interface:
        case Message(fields=fields):
            return (fields,)
        case Service(request=request, response=response):
            return (request, response)
        case Action(goal=goal, result=result, feedback=feedback):
            return (goal, result, feedback)


def _named(type_: Type) -> Iterator[Named]:
    if isinstance(type_, Array):
        yield from _named(type_.element)
    elif isinstance(type_, Named):
        yield type_


def _type(field: Field, types: RosTypes, report: Diagnostics) -> str:
    match field.type:
        case Array(element=Array()):
            report.report(
                "unsupported-construct",
                field.origin,
                target=TARGET,
                construct="an array of arrays in a message",
            )
            return ""
        case Array(element=element, size=size):
            return f"{_element(element, types)}[{'' if size is None else size}]"
        case other:
            return _element(other, types)


def _element(type_: Type, types: RosTypes) -> str:
    if not isinstance(type_, Named):
        return str(type_)
    if type_.package == "std_msgs" and type_.name == "Header":
        return "std_msgs/Header"
    package = types.ros_package(type_)
    return type_.name if package == types.package else f"{package}/{type_.name}"
