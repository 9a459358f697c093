"""Render the view: the files of target `ros2`, and further files for SMACH."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

from swarmdsl.codegen import Diagnostics, MappedText, OutputFile, Templates, fields_of
from swarmdsl.ir import System

from ...ros2 import render as ros2
from ...ros2.imports import Imports
from ...ros2.options import Options as RosOptions
from ...ros2.view import PackageView
from ...ros2_outcomes import render as shared
from ..names import check_keys
from ..options import Options
from .library import SMACH
from .view import SmachView, smach_view

_SHOWN = (
    "introspection.publish",
    "false",
    "publish states for smach_viewer, by a node `smach_server` in the same process",
)
"""Further parameter of each node."""


def emit(system: System, options: Options, report: Diagnostics) -> list[OutputFile]:
    """Return the files of the package with the behaviour, and of interface packages."""
    chosen = RosOptions(**{name: getattr(options, name) for name in fields_of(RosOptions)})

    def behavior(package: PackageView, report: Diagnostics) -> Iterator[OutputFile]:
        machines = system.machines_by_name
        for each in package.machines:
            check_keys(machines[each.name], report)
        views = [
            smach_view(machines[each.name], each.module, system, report)
            for each in package.machines
        ]
        return _behavior(package, views, chosen)

    return shared.emit(system, chosen, report, SMACH, behavior)


def _behavior(
    package: PackageView, views: list[SmachView], options: RosOptions
) -> Iterator[OutputFile]:
    root = package.name
    head = shared.header(package, options)
    values = {"package": package, "views": views, "header": head}
    readme = _fill("README.md", **values, **ros2.tables(package, options, _SHOWN))
    yield from shared.shared_files(package, options, readme, Path(__file__).parent / "runtime")
    imports = Imports({})
    imports.module("pytest")
    imports.name(f"{root}.states", "check")
    for view in views:
        imports.name(root, view.module)
    text = _fill("test_smach.py", imports=imports.lines(), **values)
    yield OutputFile(f"{root}/test/test_smach.py", text)
    for view, machine in zip(views, package.machines, strict=True):
        head = f"{ros2.legal_head(options)}# {machine.header}"
        text = _fill("machine.py", machine=view, header=head)
        yield shared.module_file(machine, package, SMACH, text)


def _fill(template: str, **values: object) -> MappedText:
    return _templates().fill(f"{template}.j2", **values)


@cache
def _templates() -> Templates:
    return Templates(Path(__file__).parents[1] / "templates" / "ros2")
