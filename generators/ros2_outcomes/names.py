"""Names of machines and interfaces that are invalid in addition to those of `ros2`."""

from __future__ import annotations

from swarmdsl.codegen import Diagnostics, Span

from ..ros2.view import PackageView
from .library import Library

_MODULES = ("following", "library", "runner", "states")


def check_names(package: PackageView, library: Library, report: Diagnostics) -> None:
    """Report clashing modules, and packages that would hide the library."""

    def bad(name: str, use: str, at: Span | None) -> None:
        report.report("bad-identifier", at, target=library.target, name=name, use=use)

    charts = {machine.module for machine in package.machines}
    for machine in package.machines:
        module = f"{machine.module}{library.suffix}"
        if machine.module in _MODULES or module in charts:
            name = module if module in charts else machine.module
            bad(name, "a module name", machine.origin)
    for each in package.interfaces:
        if each.name in library.packages:
            at = each.interfaces[0].origin
            bad(each.name, f"the name of a ROS package: {library.name} has a package with it", at)
