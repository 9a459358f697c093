"""Render the view: the files of target `ros2`, and further files for YASMIN."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

from swarmdsl.codegen import Diagnostics, MappedText, OutputFile, Templates
from swarmdsl.ir import System

from ..ros2 import render as ros2
from ..ros2.imports import Imports
from ..ros2.options import Options
from ..ros2.view import PackageView
from ..ros2_outcomes import render as shared
from .library import YASMIN
from .view import FsmView, fsm_view

_VIEWER = ("viewer.publish", "true", "publish states for `yasmin_viewer`")
"""Further parameter of each node."""


def emit(system: System, options: Options, report: Diagnostics) -> list[OutputFile]:
    """Return the files of the package with the behaviour, and of interface packages."""

    def behavior(package: PackageView, report: Diagnostics) -> Iterator[OutputFile]:
        machines = system.machines_by_name
        views = [
            fsm_view(machines[each.name], each.module, package.name, system, report)
            for each in package.machines
        ]
        return _behavior(package, views, options)

    return shared.emit(system, options, report, YASMIN, behavior)


def _behavior(package: PackageView, views: list[FsmView], options: Options) -> Iterator[OutputFile]:
    root = package.name
    head = shared.header(package, options)
    values = {"package": package, "views": views, "header": head}
    readme = _fill("README.md", **values, **ros2.tables(package, options, _VIEWER))
    yield from shared.shared_files(package, options, readme, Path(__file__).parent / "runtime")
    imports = _imports_of_test(package, views)
    text = _fill("test/test_yasmin.py", imports=imports, **values)
    yield OutputFile(f"{root}/test/test_yasmin.py", text)
    for fsm, machine in zip(views, package.machines, strict=True):
        head = f"{ros2.legal_head(options)}# {machine.header}"
        text = _fill("package/fsm.py", fsm=fsm, header=head)
        yield shared.module_file(machine, package, YASMIN, text)
        path = f"{root}/state_machines/{fsm.chart}.xml"
        yield OutputFile(path, fsm.xml, origin=fsm.origin)


def _imports_of_test(package: PackageView, views: list[FsmView]) -> list[str]:
    imports = Imports({})
    imports.name("pathlib", "Path")
    for module in ("pytest", "yasmin", "yasmin_factory"):
        imports.module(module)
    for fsm in views:
        imports.name(package.name, fsm.module)
    return imports.lines()


def _fill(template: str, **values: object) -> MappedText:
    return _templates().fill(f"{template}.j2", **values)


@cache
def _templates() -> Templates:
    return Templates(Path(__file__).parent / "templates")
