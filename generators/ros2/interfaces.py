"""The interfaces that the model itself defines: their files, and the packages these are in."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.dataclass import dataclass
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.exchange.constants import constant
from swarmdsl.graph import cycles
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

from . import names
from .names import TARGET, parts

FOLDERS = {Message: "msg", Service: "srv", Action: "action"}
_TIMES = {"time": "builtin_interfaces/Time", "duration": "builtin_interfaces/Duration"}


@dataclass(frozen=True)
class InterfacePackage:
    """A package of interfaces; `depends` are those whose messages are in its fields."""

    name: str
    interfaces: tuple[Interface, ...]
    depends: tuple[str, ...]


def interface_packages(
    system: System, behavior: str, report: Diagnostics
) -> tuple[InterfacePackage, ...]:
    """The packages to generate beside the package `behavior`."""
    by_name: dict[str, list[Interface]] = {}
    for interface in system.interfaces:
        if not interface.external:
            by_name.setdefault(interface.type.package, []).append(interface)
    found = tuple(
        InterfacePackage(name, tuple(interfaces), tuple(sorted(_depends(interfaces) - {name})))
        for name, interfaces in by_name.items()
    )
    for package in found:
        names.check_interface_package(package.name, package.interfaces, behavior, report)
    names.check_other_interfaces(system, by_name, behavior, report)
    _check_cycles(found, report)
    return found


def file_name(interface: Interface) -> str:
    """The path of its file in its package."""
    folder = FOLDERS[type(interface)]
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
            lines += [*_comments(field.doc), _field(field, interface.type.package, report)]
    return "".join(f"{line}\n" for line in lines)


def named(type_: Type) -> Iterator[Named]:
    """The message that is in a type, if there is one."""
    if isinstance(type_, Array):
        yield from named(type_.element)
    elif isinstance(type_, Named):
        yield type_


def _depends(interfaces: Iterable[Interface]) -> set[str]:
    found: set[str] = set()
    for interface in interfaces:
        for field in (field for part in parts(interface) for field in part):
            element = field.type.element if isinstance(field.type, Array) else field.type
            if isinstance(element, Named):
                found.add(element.package)
            elif isinstance(element, Primitive) and element.name in _TIMES:
                found.add("builtin_interfaces")
        if isinstance(interface, Action):
            found.add("action_msgs")
    return found


def _check_cycles(packages: Iterable[InterfacePackage], report: Diagnostics) -> None:
    """A package is built after those it depends on."""
    known = {package.name: package for package in packages}
    for name, way in cycles(
        known, lambda name: [(other, other) for other in known[name].depends if other in known]
    ):
        report.report(
            "unsupported-construct",
            known[name].interfaces[0].origin,
            target=TARGET,
            construct=f"packages whose interfaces need each other ({' -> '.join([name, *way])})",
        )


def _comments(text: str) -> list[str]:
    return [f"# {line}".rstrip() for line in comment_lines(text)]


def _constant(declared: Constant, report: Diagnostics) -> str:
    value = constant(declared.value, {})
    if not isinstance(declared.type, Primitive) or declared.type.name in _TIMES:
        _unsupported(f"a constant of type `{declared.type}`", declared.origin, report)
    elif value is None:
        _unsupported("a constant whose value is not known", declared.origin, report)
    elif isinstance(value, str) and not value.isprintable():
        _unsupported("a constant with line breaks", declared.origin, report)
    text = value
    if isinstance(value, str):
        text = '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    elif isinstance(value, bool):
        text = str(value).lower()
    return f"{_type(declared.type, '', declared.origin, report)} {declared.name}={text}"


def _field(field: Field, package: str, report: Diagnostics) -> str:
    element, size = field.type, ""
    if isinstance(field.type, Array):
        element = field.type.element
        bound = "<=" if field.type.bounded else ""
        size = f"[{bound}{'' if field.type.size is None else field.type.size}]"
    if isinstance(element, Array):
        _unsupported("an array of arrays in a message", field.origin, report)
        return ""
    return f"{_type(element, package, field.origin, report)}{size} {field.name}"


def _type(type_: Type, package: str, origin: Span | None, report: Diagnostics) -> str:
    if isinstance(type_, Primitive):
        return _TIMES.get(type_.name, str(type_))
    return type_.name if isinstance(type_, Named) and type_.package == package else str(type_)


def _unsupported(construct: str, origin: Span | None, report: Diagnostics) -> None:
    report.report("unsupported-construct", origin, target=TARGET, construct=construct)
