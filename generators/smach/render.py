"""From the view to files: each template fills in one kind of file of the package."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.generator import OutputFile
from swarmdsl.ir import System

from .interfaces import definition, file_name
from .options import Options
from .python import docstring, one_line
from .view import PackageView, package_view


def emit(system: System, options: Options, report: Diagnostics) -> list[OutputFile]:
    """The files of the package."""
    package = package_view(system, options, report)
    return [] if package is None else list(_files(package, report))


def _files(package: PackageView, report: Diagnostics) -> Iterator[OutputFile]:
    root, source = package.name, f"{package.name}/src/{package.name}"
    by_kind: dict[str, list[str]] = {}
    for interface in package.interfaces:
        path = file_name(interface)
        folder, _, file = path.partition("/")
        kind = {"msg": "message", "srv": "service", "action": "action"}[folder]
        by_kind.setdefault(kind, []).append(file)
        text = definition(interface, package.types, report)
        yield OutputFile(f"{root}/{path}", text, origin=interface.origin)
    common = {"package": package, "header": package.header}
    yield OutputFile(f"{root}/package.xml", package.manifest)
    yield OutputFile(
        f"{root}/CMakeLists.txt",
        _fill("CMakeLists.txt", interface_files=list(by_kind.items()), **common),
    )
    yield OutputFile(f"{root}/setup.py", _fill("setup.py", **common))
    init = _fill("src/package/__init__.py", doc=docstring(package.doc), **common)
    yield OutputFile(f"{source}/__init__.py", init)
    for module in ("containers", "states"):
        yield OutputFile(f"{source}/{module}.py", _fill(f"src/package/{module}.py", **common))
    if package.events:
        yield OutputFile(f"{source}/events.py", _fill("src/package/events.py", **common))
    if package.callbacks:
        text = _fill("src/package/callbacks.py", **common)
        yield OutputFile(f"{source}/callbacks.py", text, keep=True)
    for machine in package.machines:
        text = _fill("src/package/machine.py", machine=machine, **common)
        yield OutputFile(f"{source}/{machine.module}.py", text, origin=machine.origin)
        required = one_line(tuple(f"~{name}" for name in machine.required_params))
        text = _fill("scripts/node", machine=machine, required=required, **common)
        path = f"{root}/scripts/{machine.module}"
        yield OutputFile(path, text, executable=True, origin=machine.origin)


def _fill(template: str, **values: object) -> str:
    return _environment().get_template(f"package/{template}.j2").render(**values)


@cache
def _environment() -> Environment:
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent / "templates"),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters["repr"] = repr
    return environment
