"""Packages of interfaces: their files and dependencies."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.graphs import cycles
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.ros.interface_files import (
    Generation,
    definition,
    depends,
    interface_parts,
    interface_path,
    named_types,
)
from swarmdsl.ir import Interface, Named, System


@dataclass(frozen=True)
class InterfacePackage:
    """Package of interfaces; `depends` are the packages of types in its fields."""

    name: str
    interfaces: tuple[Interface, ...]
    depends: tuple[str, ...]


def group_by_package(
    interfaces: Iterable[Interface], ros: Generation
) -> tuple[InterfacePackage, ...]:
    """Return the packages of the interfaces, in the order of first appearance."""
    by_name: dict[str, list[Interface]] = {}
    for interface in interfaces:
        by_name.setdefault(interface.type.package, []).append(interface)
    return tuple(
        InterfacePackage(name, tuple(each), tuple(sorted(depends(each, ros) - {name})))
        for name, each in by_name.items()
    )


def interfaces_to_write(system: System, extra: str) -> list[Interface]:
    """Return the interfaces to write: the model's own and those of `extra` packages.

    `extra` are comma-separated packages that no workspace has, but that the model or its
    libraries describe.
    """
    packages = extra.split(",")
    return [
        each for each in system.interfaces if not each.external or each.type.package in packages
    ]


def check_described(system: System, extra: str, target: str, report: Diagnostics) -> None:
    """Report used interfaces of packages to write that nothing describes."""
    packages = extra.split(",")
    used = [(event.type, event.origin) for event in system.events if not event.predefined]
    used += ((each.communication.type, each.origin) for each in system.functions)
    fields = (
        f
        for each in interfaces_to_write(system, extra)
        for part in interface_parts(each)
        for f in part
    )
    used += ((type_, field.origin) for field in fields for type_ in named_types(field.type))
    first: dict[Named, Span | None] = {}
    for type_, origin in used:
        if isinstance(type_, Named) and type_.package in packages:
            first.setdefault(type_, origin)
    for type_, origin in first.items():
        if system.interface(type_) is None:
            construct = (
                f"`{type_}`, which the model does not describe, in a package that is written"
            )
            report.report("unsupported-construct", origin, target=target, construct=construct)


def third_party_packages(
    used: Iterable[Named], made: Iterable[InterfacePackage], system: System
) -> list[str]:
    """Return the packages of used interfaces that are not `made` or ROS's own."""
    known = {*system.ros_packages, *(package.name for package in made)}
    return sorted({type_.package for type_ in used} - known)


def is_fully_described(system: System, package: str) -> bool:
    """Return True if every used interface of a third-party package is known."""
    found = Diagnostics()
    check_described(system, package, "", found)
    return not found.has_errors


def check_order(packages: Iterable[InterfacePackage], target: str, report: Diagnostics) -> None:
    """Report packages that depend on each other: they cannot be built in an order."""
    known = {package.name: package for package in packages}
    for name, path in cycles(
        known, lambda name: [(other, other) for other in known[name].depends if other in known]
    ):
        chain = " -> ".join([name, *path])
        report.report(
            "unsupported-construct",
            known[name].interfaces[0].origin,
            target=target,
            construct=f"packages whose interfaces depend on each other ({chain})",
        )


def definition_files(
    package: InterfacePackage, ros: Generation, target: str, report: Diagnostics
) -> Iterator[OutputFile]:
    """Yield the .msg, .srv and .action files of a package."""

    def complain(construct: str, at: Span | None) -> None:
        report.report("unsupported-construct", at, target=target, construct=construct)

    for interface in package.interfaces:
        text = definition(interface, ros, complain)
        yield OutputFile(
            f"{package.name}/{interface_path(interface)}", text, origin=interface.origin
        )
