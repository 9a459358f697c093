"""The packages of the interfaces that nodes need and that the model describes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import cast

from swarmdsl.dataclass import dataclass, replace
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.graph import cycles
from swarmdsl.interface_files import Generation, bad_names, depends, parts
from swarmdsl.ir import Interface, System
from swarmdsl.naming import is_ros_package_name
from swarmdsl.source import Span

from .names import is_cpp_word
from .nodes import TARGET, Node
from .options import Options


@dataclass(frozen=True)
class InterfacePackage:
    """A package of interfaces; `depends` are those whose messages are in its fields."""

    name: str
    interfaces: tuple[Interface, ...]
    depends: tuple[str, ...]


@dataclass(frozen=True)
class Packages:
    """The nodes with the interfaces in their packages, and the packages of other interfaces."""

    nodes: tuple[tuple[Node, InterfacePackage | None], ...]
    interfaces: tuple[InterfacePackage, ...]


def generation(options: Options) -> Generation:
    """The generation of ROS that was asked for."""
    return cast("Generation", options.ros)


def packages(
    system: System, nodes: Iterable[Node], options: Options, report: Diagnostics
) -> Packages:
    """Share the interfaces out.

    Those of the model have packages of their own. An action that the model says to be in the
    package of a function is described there, as the libraries of CPSwarm do it: nobody else
    will. In ROS 2 a package of nodes cannot hold interfaces, so that the node gives way.
    """
    ros = generation(options)
    by_name: dict[str, list[Interface]] = {}
    for interface in system.interfaces:
        if not interface.external:
            by_name.setdefault(interface.type.package, []).append(interface)
    own = set(by_name)
    functions = {node.package for node in nodes}
    for interface in system.interfaces:
        if interface.external and interface.type.package in functions:
            by_name.setdefault(interface.type.package, []).append(interface)
    found = {
        name: InterfacePackage(
            name, tuple(interfaces), tuple(sorted(depends(interfaces, ros) - {name}))
        )
        for name, interfaces in by_name.items()
    }
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
    _check_cycles([*written, *inner], report)
    return Packages(tuple(placed), tuple(written))


def _check_described(node: Node, system: System, report: Diagnostics) -> None:
    """What belongs to the node's package must be known: nobody else writes that package."""
    for type_, kind in node.types:
        if type_.package == node.package and system.interface(type_) is None:
            construct = (
                f"`{type_}`, which the model does not describe, in a package that is written"
            )
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
        for name, use, at in bad_names(interface, generation(options)):
            _bad(name, use, at, report)
        for field in (field for part in parts(interface) for field in part):
            if options.language == "cpp" and is_cpp_word(field.name):
                _bad(field.name, "the name of a field in C++", field.origin, report)


def _check_cycles(written: Iterable[InterfacePackage], report: Diagnostics) -> None:
    """A package is built after those it depends on."""
    known = {package.name: package for package in written}
    for name, way in cycles(
        known, lambda name: [(other, other) for other in known[name].depends if other in known]
    ):
        report.report(
            "unsupported-construct",
            known[name].interfaces[0].origin,
            target=TARGET,
            construct=f"packages whose interfaces need each other ({' -> '.join([name, *way])})",
        )


def _bad(name: str, use: str, at: Span | None, report: Diagnostics) -> None:
    report.report("bad-identifier", at, target=TARGET, name=name, use=use)
