"""Files of packages whose machines run in a library."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

from swarmdsl.codegen import Diagnostics, MappedText, OutputFile, Span
from swarmdsl.ir import System

from ..ros2 import render as ros2
from ..ros2.imports import WIDTH
from ..ros2.options import Options
from ..ros2.view import MachineView, PackageView, package_view
from ..runtime_source import runtime_source
from .library import Library
from .names import check_names

Behavior = Callable[[PackageView, Diagnostics], Iterable[OutputFile]]


def emit(
    system: System, options: Options, report: Diagnostics, library: Library, behavior: Behavior
) -> list[OutputFile]:
    """Return the files of the package that `behavior` makes, and of interface packages."""
    found = _Report(library.target)
    package = package_view(system, options, found, library.variant)
    files: list[OutputFile] = []
    if package is not None:
        check_names(package, library, found)
        files += behavior(package, found)
        for each in package.interfaces:
            files += ros2.interface_files(each, options, found)
    report.include(found)
    return files


class _Report(Diagnostics):
    """Diagnostics that name the target of the library instead of `ros2`."""

    def __init__(self, target: str) -> None:
        super().__init__()
        self._target = target

    def report(self, name: str, at: Span | None = None, /, **fields: Any) -> None:
        if "target" in fields:
            fields["target"] = self._target
        super().report(name, at, **fields)


def shared_files(
    package: PackageView, options: Options, readme: str, runtime: Path
) -> Iterator[OutputFile]:
    """Yield the files that all libraries share, and its modules from folder `runtime`."""
    root = package.name
    for file in ros2.files(package, options):
        yield OutputFile(file.path, readme) if file.path == f"{root}/README.md" else file
    head = header(package, options)
    own = Path(__file__).parent / "runtime"
    for folder, module in (
        (own, "following"),
        (own, "runner"),
        (runtime, "library"),
        (runtime, "states"),
    ):
        text = runtime_source(folder / f"{module}.py", head)
        yield OutputFile(f"{root}/{root}/{module}.py", text)


def header(package: PackageView, options: Options) -> str:
    """Return the header of a file of the package."""
    return f"{ros2.legal_head(options)}# {package.header}"


def module_file(
    machine: MachineView, package: PackageView, library: Library, text: MappedText
) -> OutputFile:
    """Return the module of a machine in the library."""
    path = f"{package.name}/{package.name}/{machine.module}{library.suffix}.py"
    return OutputFile(path, text.rewritten(WIDTH, ros2.narrowed), origin=machine.origin)
