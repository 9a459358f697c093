"""Render the view: the files of the packages."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

from swarmdsl.codegen import (
    Diagnostics,
    OutputFile,
    Templates,
    chosen_machines,
    engine_folder,
    fits,
)
from swarmdsl.codegen.python import docstring
from swarmdsl.codegen.ros import InterfacePackage, definition_files, interface_path, manifest
from swarmdsl.codegen.shared import member_uses
from swarmdsl.ir import System

from ..runtime_source import runtime_source
from .launch_files import launch_files
from .module import TARGET
from .options import Options
from .view import PackageView, package_view

_RUNTIME = Path(__file__).parent / "runtime"


def emit(system: System, options: Options, report: Diagnostics) -> list[OutputFile]:
    """Return the files of the package with the behaviour, and of interface packages."""
    if options.ros == 2:
        from .ros2 import render as ros2  # not needed for ROS 1

        return ros2.emit(system, options, report)
    _report_members(system, report)
    if report.has_errors:
        return []
    package = package_view(system, options, report)
    if package is None:
        return []
    interfaces = [_interfaces(each, options, report) for each in package.interfaces]
    return [*_files(package), *(file for files in interfaces for file in files)]


def _report_members(system: System, report: Diagnostics) -> None:
    """Report uses of heartbeats, which nodes of ROS 1 do not send."""
    for machine in chosen_machines(system):
        for feature, place in member_uses(machine):
            report.report(
                "unsupported-construct",
                place,
                target=TARGET,
                construct=feature.value,
                help="nodes of ROS 1 send no heartbeats: build it for ROS 2 with `--option "
                "smach.ros=2`, or with target `ros2`",
            )


def _interfaces(
    package: InterfacePackage, options: Options, report: Diagnostics
) -> Iterator[OutputFile]:
    """Yield the files of an interface package."""
    by_kind: dict[str, list[str]] = {}
    for interface in package.interfaces:
        folder, _, file = interface_path(interface).partition("/")
        kind = {"msg": "message", "srv": "service", "action": "action"}[folder]
        by_kind.setdefault(kind, []).append(file)
    yield from definition_files(package, 1, TARGET, report)
    at = package.interfaces[0].origin
    files = list(by_kind.items())
    text = _fill("interfaces/CMakeLists.txt", package=package, interface_files=files)
    yield OutputFile(f"{package.name}/CMakeLists.txt", text, origin=at)
    depends = [
        ("buildtool_depend", "catkin"),
        ("build_depend", "message_generation"),
        *(("depend", name) for name in package.depends),
        ("exec_depend", "message_runtime"),
    ]
    doc = f"Interfaces of {package.name}."
    text = manifest(package.name, doc, depends, options, format_=2)
    yield OutputFile(f"{package.name}/package.xml", text, origin=at)


def _files(package: PackageView) -> Iterator[OutputFile]:
    root, source = package.name, f"{package.name}/src/{package.name}"
    common = {"package": package, "header": package.header, "timeouts": package.timeouts}
    yield OutputFile(f"{root}/package.xml", package.manifest)
    yield OutputFile(f"{root}/CMakeLists.txt", _fill("package/CMakeLists.txt", **common))
    yield OutputFile(f"{root}/setup.py", _fill("package/setup.py", **common))
    init = f'# {package.header}\n"""{docstring(package.doc)}"""\n'
    yield OutputFile(f"{source}/__init__.py", init)
    for module in package.modules:
        yield OutputFile(f"{source}/{module}.py", _runtime(package, f"{module}.py"))
    yield from _engine(f"{source}/engine", package.header)
    yield OutputFile(f"{root}/README.md", _fill("package/README.md", **common))
    yield from launch_files(package)
    if package.robots:
        text = _runtime(package, "test/test_machine.py")
        yield OutputFile(f"{root}/test/test_machine.py", text, executable=True)
    if package.events:
        yield OutputFile(f"{source}/events.py", _fill("package/src/package/events.py", **common))
    if package.callbacks:
        facts = tuple(f"{name}({parameters})" for name, parameters in package.callbacks)
        text = _fill("package/src/package/callbacks.py", stamp=fits(facts), **common)
        yield OutputFile(f"{source}/callbacks.py", text, keep=True, owner=root, facts=facts)
    for machine in package.machines:
        text = _fill("package/src/package/machine.py", machine=machine, **common)
        yield OutputFile(f"{source}/{machine.module}.py", text, origin=machine.origin)
        text = _fill("package/scripts/node", machine=machine, **common)
        path = f"{root}/scripts/{machine.module}"
        yield OutputFile(path, text, executable=True, origin=machine.origin)


def _runtime(package: PackageView, path: str) -> str:
    """Return the source of a module in the folder `runtime`."""
    timeouts: dict[str, object] = {
        f"_{name.upper()}": seconds for name, seconds in package.timeouts.items()
    }
    constants: dict[str, dict[str, object]] = {
        "actions.py": timeouts,
        "services.py": {"_MISSING_SERVER": timeouts["_MISSING_SERVER"]},
        "test/test_machine.py": {"PACKAGE": package.name},
    }
    header = f"# {package.header}"
    return runtime_source(_RUNTIME / path, header, **constants.get(path, {}))


def _engine(folder: str, header: str) -> Iterator[OutputFile]:
    """Yield the modules of the engine."""
    for file in sorted(engine_folder().glob("*.py")):
        text = f"# {header}\n{file.read_text(encoding='utf-8')}"
        yield OutputFile(f"{folder}/{file.name}", text)


def _fill(template: str, **values: object) -> str:
    return _templates().fill(f"{template}.j2", **values)


@cache
def _templates() -> Templates:
    return Templates(Path(__file__).parent / "templates")
