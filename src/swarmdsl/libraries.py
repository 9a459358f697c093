"""Where packages of models lie: `import cpswarm.uav.*`.

A package `a.b` is the file `a/b.swarm` or the .swarm files in the folder `a/b` of a library.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.source import Span
from swarmdsl.suggest import did_you_mean
from swarmdsl.syntax import Import, ImportLibrary

SUFFIX = ".swarm"


def imported_names(statement: Import) -> str | None:
    """The one name that an import brings in, None where it brings in all."""
    if isinstance(statement, ImportLibrary) and not statement.name.endswith(".*"):
        return statement.name.rpartition(".")[2]
    return None


def find_package(
    statement: ImportLibrary, libraries: Sequence[Path], report: Diagnostics
) -> list[Path]:
    """The files of a package, from the first library that has it; reported when none has."""
    package = statement.name.rpartition(".")[0]
    parts = package.split(".")
    for library in libraries if package else ():
        place = library.joinpath(*parts)
        if place.with_suffix(SUFFIX).is_file():
            return [place.with_suffix(SUFFIX)]
        if place.is_dir() and (files := sorted(place.glob(f"*{SUFFIX}"))):
            return files
    report.report(
        "unknown-package",
        place_of(statement),
        name=package or statement.name,
        help=_advice(statement, package, libraries),
    )
    return []


def place_of(statement: Import) -> Span:
    """Where an import says what it imports."""
    if isinstance(statement, ImportLibrary):
        end = statement.span.end
        return Span(statement.span.source, end - len(statement.name), end)
    return statement.path.span


def _advice(statement: ImportLibrary, package: str, libraries: Sequence[Path]) -> str | None:
    if not package:
        return f"write `import {statement.name}.*` for all that a package declares"
    names = {
        ".".join(path.relative_to(library).with_suffix("").parts)
        for library in libraries
        for path in (*library.glob(f"*/*{SUFFIX}"), *library.glob(f"*{SUFFIX}"))
    }
    return did_you_mean(package, names)
