"""The packages that interfaces are in, as a generator writes them: what each needs, its files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.dataclass import dataclass
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.generator import OutputFile
from swarmdsl.graph import cycles
from swarmdsl.interface_files import Generation, definition, depends, file_name
from swarmdsl.ir import Interface
from swarmdsl.source import Span


@dataclass(frozen=True)
class InterfacePackage:
    """A package of interfaces; `depends` are those whose messages are in its fields."""

    name: str
    interfaces: tuple[Interface, ...]
    depends: tuple[str, ...]


def packages_of(interfaces: Iterable[Interface], ros: Generation) -> tuple[InterfacePackage, ...]:
    """The packages that the interfaces are in, in the order in which they first appear."""
    by_name: dict[str, list[Interface]] = {}
    for interface in interfaces:
        by_name.setdefault(interface.type.package, []).append(interface)
    return tuple(
        InterfacePackage(name, tuple(each), tuple(sorted(depends(each, ros) - {name})))
        for name, each in by_name.items()
    )


def check_order(packages: Iterable[InterfacePackage], target: str, report: Diagnostics) -> None:
    """Report packages that need each other: each is built after those it depends on."""
    known = {package.name: package for package in packages}
    for name, way in cycles(
        known, lambda name: [(other, other) for other in known[name].depends if other in known]
    ):
        report.report(
            "unsupported-construct",
            known[name].interfaces[0].origin,
            target=target,
            construct=f"packages whose interfaces need each other ({' -> '.join([name, *way])})",
        )


def definitions(
    package: InterfacePackage, ros: Generation, target: str, report: Diagnostics
) -> Iterator[OutputFile]:
    """The .msg, .srv and .action files of a package."""

    def complain(construct: str, at: Span | None) -> None:
        report.report("unsupported-construct", at, target=target, construct=construct)

    for interface in package.interfaces:
        text = definition(interface, ros, complain)
        yield OutputFile(f"{package.name}/{file_name(interface)}", text, origin=interface.origin)
