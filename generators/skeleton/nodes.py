"""Which nodes a model needs, as plain data that no language or generation of ROS shows in."""

from __future__ import annotations

import keyword
import sys
from collections.abc import Iterable, Iterator
from typing import Literal

from swarmdsl.codegen import (
    Diagnostics,
    Label,
    Span,
    camel_case,
    dataclass,
    is_ros_package_name,
    snake_case,
    suggest,
)
from swarmdsl.codegen.shared import has_node
from swarmdsl.ir import Component, Function, Named, Primitive, System, Type

from .names import TARGET, identifiers, is_cpp_word
from .options import Options
from .settings import Setting, settings_of

# A package of such a name would hide what the nodes need, or is no name in their languages.
_TAKEN = frozenset(
    (
        *sys.stdlib_module_names,
        *keyword.kwlist,
        "actionlib",
        "ros",
        "rospy",
        "rclpy",
        "rclcpp",
        "test",
    )
)
# What a topic of a bare value carries. ROS has no message of an array that means the same.
_STANDARD = {
    "bool": "Bool",
    "byte": "Byte",
    "char": "Char",
    "string": "String",
    "time": "Time",
    "duration": "Duration",
    **{
        f"{sign}int{bits}": f"{sign.upper()}Int{bits}"
        for sign in ("", "u")
        for bits in (8, 16, 32, 64)
    },
    **{f"float{bits}": f"Float{bits}" for bits in (32, 64)},
}


@dataclass(frozen=True)
class Topic:
    """A topic that a node hears (`in`) or publishes on (`out`), under a name for code."""

    name: str
    topic: str
    type: Named
    doc: str
    origin: Span | None


@dataclass(frozen=True)
class Server:
    """An action or service that a node offers; a name that begins with `~` is its own."""

    method: str
    paradigm: Literal["action", "service"]
    name: str
    type: Named
    doc: str
    origin: Span | None


@dataclass(frozen=True)
class Node:
    """A node in a package of its own; `model` is what the model calls it."""

    model: str
    kind: Literal["function", "component"]
    package: str
    class_name: str
    servers: tuple[Server, ...]
    inputs: tuple[Topic, ...]
    outputs: tuple[Topic, ...]
    settings: tuple[Setting, ...]
    doc: str
    origin: Span | None

    @property
    def action(self) -> Server | None:
        """The action that it offers, if it does."""
        return next((server for server in self.servers if server.paradigm == "action"), None)

    @property
    def services(self) -> tuple[Server, ...]:
        """The services that it offers."""
        return tuple(server for server in self.servers if server.paradigm == "service")

    @property
    def uses(self) -> Iterator[tuple[Named, str, Span | None]]:
        """The interfaces that it uses, as `msg`, `srv` or `action`, and where."""
        kinds = {"action": "action", "service": "srv"}
        for server in self.servers:
            yield server.type, kinds[server.paradigm], server.origin
        for topic in (*self.inputs, *self.outputs):
            yield topic.type, "msg", topic.origin

    @property
    def types(self) -> list[tuple[Named, str]]:
        """The interfaces that it uses, each once."""
        return list(dict.fromkeys((type_, kind) for type_, kind, _ in self.uses))


def nodes(system: System, options: Options, report: Diagnostics) -> list[Node]:
    """A node for each function that no library has, and for each component of the model."""
    operations = {name for component in system.components for name in component.operations}
    for member in system.members:
        operations |= {name for part in member.parts for name in part.operations}
    found = [
        _of_function(function, options, report)
        for function in system.functions
        if not function.in_library and function.name not in operations
    ]
    found += (
        _of_component(component, system, options, report)
        for component in system.components
        if has_node(component)
    )
    chosen = _chosen(found, options.only, report)
    _check_packages(chosen, report)
    return chosen


def _chosen(found: list[Node], only: str, report: Diagnostics) -> list[Node]:
    wanted = [name.strip() for name in only.split(",") if name.strip()]
    known = {node.model: node for node in found}
    for name in wanted:
        if name not in known:
            fault = f"there is no function or component `{name}` to write"
            hint = suggest(name, known, "functions and components")
            report.report("bad-option", target=TARGET, fault=fault, help=hint)
    return [node for node in found if not wanted or node.model in wanted]


def _of_function(function: Function, options: Options, report: Diagnostics) -> Node:
    call = function.communication
    directions: dict[str, list[tuple[str, str, Type, str, Span | None]]] = {"in": [], "out": []}
    for port in function.ports:
        directions[port.direction].append(
            (port.topic, port.topic, port.type, port.doc, port.origin)
        )
    return Node(
        model=function.name,
        kind="function",
        package=snake_case(function.name),
        class_name=camel_case(function.name),
        servers=(Server("execute", call.paradigm, call.name, call.type, call.doc, call.origin),),
        inputs=tuple(_topics(directions["in"], report)),
        outputs=tuple(_topics(directions["out"], report)),
        settings=tuple(settings_of(function.params, options.ros, report)),
        doc=function.doc,
        origin=function.origin,
    )


def _of_component(
    component: Component, system: System, options: Options, report: Diagnostics
) -> Node:
    ports = [
        (port.direction, (port.name, port.topic, port.type, port.doc, port.origin))
        for port in component.ports
    ]
    functions = [system.function(name) for name in component.operations]
    methods = identifiers(function.communication.name.rpartition("/")[2] for function in functions)
    servers = tuple(
        # The namespace of a component's operations is the name of its node.
        Server(
            method,
            "service",
            f"~{function.communication.name.rpartition('/')[2]}",
            function.communication.type,
            function.doc,
            function.origin,
        )
        for function, method in zip(functions, methods, strict=True)
    )
    return Node(
        model=component.name,
        kind="component",
        package=snake_case(component.name),
        class_name=camel_case(component.name),
        servers=servers,
        inputs=tuple(_topics([port for way, port in ports if way != "out"], report)),
        outputs=tuple(_topics([port for way, port in ports if way != "in"], report)),
        settings=tuple(settings_of(component.params, options.ros, report)),
        doc=component.doc,
        origin=component.origin,
    )


def _topics(
    ports: list[tuple[str, str, Type, str, Span | None]], report: Diagnostics
) -> Iterator[Topic]:
    names = identifiers(name for name, *_ in ports)
    for name, (_, topic, type_, doc, origin) in zip(names, ports, strict=True):
        message = _message(type_)
        if message is None:
            _unsupported(f"a topic of type `{type_}`, which is no message", origin, report)
        else:
            yield Topic(name, topic, message, doc, origin)


def _message(type_: Type) -> Named | None:
    if isinstance(type_, Primitive) and type_.name in _STANDARD:
        return Named("std_msgs", _STANDARD[type_.name])
    return type_ if isinstance(type_, Named) else None


def _check_packages(found: Iterable[Node], report: Diagnostics) -> None:
    owners: dict[str, Node] = {}
    for node in found:
        if (
            not is_ros_package_name(node.package)
            or node.package in _TAKEN
            or is_cpp_word(node.package)
        ):
            _bad(node.model, "the name of a ROS package", node.origin, report)
        owner = owners.setdefault(node.package, node)
        if owner is not node:
            related = (Label(owner.origin, "the first is here"),) if owner.origin else ()
            use = f"a package of two nodes, those of `{owner.model}` and `{node.model}`"
            _bad(node.package, use, node.origin, report, related)


def _bad(
    name: str,
    use: str,
    at: Span | None,
    report: Diagnostics,
    related: tuple[Label, ...] = (),
) -> None:
    report.report("bad-identifier", at, target=TARGET, name=name, use=use, related=related)


def _unsupported(construct: str, at: Span | None, report: Diagnostics) -> None:
    report.report("unsupported-construct", at, target=TARGET, construct=construct)
