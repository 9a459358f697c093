"""Packages of the interfaces that nodes need and the model describes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import cast

from swarmdsl.codegen import Diagnostics, Span, dataclass, is_ros_package_name, replace
from swarmdsl.codegen.ros import (
    Generation,
    InterfacePackage,
    check_order,
    group_by_package,
    interface_parts,
    invalid_names,
)
from swarmdsl.ir import System

from .names import TARGET, is_cpp_word
from .nodes import Node
from .options import Options


@dataclass(frozen=True)
class Packages:
    """Nodes with the interfaces in their packages, and packages of other interfaces."""

    nodes: tuple[tuple[Node, InterfacePackage | None], ...]
    interfaces: tuple[InterfacePackage, ...]


def generation(options: Options) -> Generation:
    """Return the version of ROS that the options select."""
    return cast("Generation", options.ros)


def packages(
    system: System, nodes: Iterable[Node], options: Options, report: Diagnostics
) -> Packages:
    """Assign interfaces to packages.

    Interfaces of the model have packages of their own. An action that the model puts in the
    package of a function is described there, as in the libraries of CPSwarm. In ROS 2 a package of
    nodes cannot contain interfaces, so the node gets another package.
    """
    ros = generation(options)
    interfaces = [interface for interface in system.interfaces if not interface.external]
    own = {interface.type.package for interface in interfaces}
    functions = {node.package for node in nodes}
    interfaces += (
        interface
        for interface in system.interfaces
        if interface.external and interface.type.package in functions
    )
    found = {package.name: package for package in group_by_package(interfaces, ros)}
    placed = []
    for node in nodes:
        _check_described(node, system, report)
        inside = found.get(node.package)
        if inside is not None and (ros == 2 or node.package in own):
            node, inside = replace(node, package=f"{node.package}_node"), None
        elif inside is not None:
            del found[node.package]
        placed.append((node, inside))
    written = [
        package for package in found.values() if options.interfaces or package.name not in own
    ]
    inner = [package for _, package in placed if package is not None]
    for package in (*written, *inner):
        _check(package, options, report)
    check_order([*written, *inner], TARGET, report)
    return Packages(tuple(placed), tuple(written))


def _check_described(node: Node, system: System, report: Diagnostics) -> None:
    """Report undescribed interfaces in a node's package, which only this target writes."""
    for type_, kind in node.types:
        if type_.package == node.package and system.interface(type_) is None:
            construct = f"`{type_}`, which the model does not describe, in a package that it writes"
            word = {"msg": "message", "srv": "service"}.get(kind, kind)
            report.report(
                "unsupported-construct",
                node.origin,
                target=TARGET,
                construct=construct,
                help=f"describe it: `{word} {type_} {{ ... }}`",
            )


def _check(package: InterfacePackage, options: Options, report: Diagnostics) -> None:
    if not is_ros_package_name(package.name):
        _bad(package.name, "the name of a ROS package", package.interfaces[0].origin, report)
    for interface in package.interfaces:
        for name, use, hint, at in invalid_names(interface, generation(options)):
            _bad(name, use, at, report, hint)
        for field in (field for part in interface_parts(interface) for field in part):
            if options.language == "cpp" and is_cpp_word(field.name):
                _bad(field.name, "the name of a field in C++", field.origin, report)


def _bad(
    name: str, use: str, at: Span | None, report: Diagnostics, hint: str | None = None
) -> None:
    report.report("bad-identifier", at, target=TARGET, name=name, use=use, help=hint)
