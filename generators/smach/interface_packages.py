"""The packages of the interfaces that the model defines: one for each package of the model."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.dataclass import dataclass
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.graph import cycles
from swarmdsl.ir import Action, Interface, System

from . import names
from .interfaces import field_packages, own_interfaces
from .module import TARGET


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
    for interface in own_interfaces(system):
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


def _depends(interfaces: Iterable[Interface]) -> set[str]:
    found = field_packages(interfaces)
    if any(isinstance(interface, Action) for interface in interfaces):
        found.add("actionlib_msgs")
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
