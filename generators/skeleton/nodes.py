"""Nodes of a model, as plain data independent of language and ROS version."""

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

# A package with such a name would hide a module of the nodes, or is invalid in a language.
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
# Messages for topics of primitive types. ROS has no equivalent message for arrays.
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
    """A topic that a node subscribes to (`in`) or publishes (`out`), with an identifier."""

    name: str
    topic: str
    type: Named
    doc: str
    origin: Span | None


@dataclass(frozen=True)
class Server:
    """An action or service of a node; a name with `~` is in the namespace of the node."""

    method: str
    paradigm: Literal["action", "service"]
    name: str
    type: Named
    doc: str
    origin: Span | None


@dataclass(frozen=True)
class Node:
    """A node in a package of its own; `model` is its name in the model."""

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
        """The action of the node, if it has one."""
        return next((server for server in self.servers if server.paradigm == "action"), None)

    @property
    def services(self) -> tuple[Server, ...]:
        """The services of the node."""
        return tuple(server for server in self.servers if server.paradigm == "service")

    @property
    def uses(self) -> Iterator[tuple[Named, str, Span | None]]:
        """The interfaces that the node uses, as `msg`, `srv` or `action`, with places."""
        kinds = {"action": "action", "service": "srv"}
        for server in self.servers:
            yield server.type, kinds[server.paradigm], server.origin
        for topic in (*self.inputs, *self.outputs):
            yield topic.type, "msg", topic.origin

    @property
    def types(self) -> list[tuple[Named, str]]:
        """The interfaces that the node uses, each once."""
        return list(dict.fromkeys((type_, kind) for type_, kind, _ in self.uses))


def nodes(system: System, options: Options, report: Diagnostics) -> list[Node]:
    """Return a node for each function outside libraries, and for each component."""
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
            fault = f"unknown function or component `{name}`"
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
        # Operations of a component are in the namespace of its node.
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
            _unsupported(f"a topic of type `{type_}`, which is not a message", origin, report)
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
            related = (Label(owner.origin, "first used here"),) if owner.origin else ()
            use = f"the package of both `{owner.model}` and `{node.model}`"
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
