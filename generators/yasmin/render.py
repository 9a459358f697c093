"""From the view to files: those of target `ros2`, and what YASMIN has besides."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.generator import OutputFile
from swarmdsl.ir import System
from swarmdsl.source import Span
from swarmdsl.source_map import MappedText
from swarmdsl.templates import Templates

from ..ros2 import render as ros2
from ..ros2.imports import Imports
from ..ros2.options import Options
from ..ros2.view import MachineView, PackageView, Variant, package_view
from . import names
from .view import FsmView, fsm_view
from .ways import TARGET

SUFFIX = "_fsm"
_VARIANT = Variant(
    host="runner",
    suffix=SUFFIX,
    depends=(
        *(("depend", name) for name in ("yasmin", "yasmin_ros", "yasmin_viewer")),
        ("test_depend", "yasmin_factory"),
    ),
    folders=(("state_machines", "*.xml"),),
)


def emit(system: System, options: Options, report: Diagnostics) -> list[OutputFile]:
    """The files of the package with the behaviour, and of those with the interfaces."""
    found = _Report()
    files = _emit(system, options, found)
    report.include(found)
    return files


class _Report(Diagnostics):
    """What is found wrong for this target, also by what belongs to target `ros2`."""

    def report(self, name: str, at: Span | None = None, /, **fields: Any) -> None:
        if "target" in fields:
            fields["target"] = TARGET
        super().report(name, at, **fields)


def _emit(system: System, options: Options, report: Diagnostics) -> list[OutputFile]:
    package = package_view(system, options, report, _VARIANT)
    if package is None:
        return []
    names.check_modules(package.machines, report)
    machines = {machine.name: machine for machine in system.machines}
    views = [
        fsm_view(machines[each.name], each.module, package.name, system, report)
        for each in package.machines
    ]
    interfaces = (ros2.interface_files(each, options, report) for each in package.interfaces)
    return [
        *_behavior(package, views, options),
        *(file for files in interfaces for file in files),
    ]


def _behavior(package: PackageView, views: list[FsmView], options: Options) -> Iterator[OutputFile]:
    root = package.name
    head = f"{ros2.legal_head(options)}# {package.header}"
    values = {"package": package, "views": views, "header": head}
    for file in ros2.files(package, options):
        if file.path == f"{root}/README.md":
            file = OutputFile(file.path, _fill("README.md", **values))
        yield file
    for module in ("following", "runner"):
        text = _fill(f"package/{module}.py", **values)
        yield OutputFile(f"{root}/{root}/{module}.py", text)
    imports = _imports_of_test(package, views)
    text = _fill("test/test_yasmin.py", imports=imports, **values)
    yield OutputFile(f"{root}/test/test_yasmin.py", text)
    for fsm, machine in zip(views, package.machines, strict=True):
        yield _module(fsm, machine, package, ros2.legal_head(options))
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


def _module(fsm: FsmView, machine: MachineView, package: PackageView, legal: str) -> OutputFile:
    text = _fill("package/fsm.py", fsm=fsm, header=f"{legal}# {machine.header}")
    path = f"{package.name}/{package.name}/{fsm.module}.py"
    return OutputFile(path, text.rewritten(ros2.within_width), origin=fsm.origin)


def _fill(template: str, **values: object) -> MappedText:
    return _templates().fill(f"{template}.j2", **values)


@cache
def _templates() -> Templates:
    return Templates(Path(__file__).parent / "templates")
