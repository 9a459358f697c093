"""Read the files to import and name the resulting model."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Literal

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import snake_case
from swarmdsl.base.read_files import MOST_DATA
from swarmdsl.base.source import Source
from swarmdsl.importing import import_adf, import_scxml
from swarmdsl.ir import System
from swarmdsl.project.read_source import read_source


def read_files(
    format_: Literal["scxml", "adf", "amf"],
    paths: Sequence[Path],
    described: Sequence[Path],
    name: str,
    known: System | None,
    guesses: set[tuple[str, str]],
    report: Diagnostics,
) -> tuple[System, int]:
    """Import files and return the system and the number of files.

    The system is empty if a file cannot be read.
    """
    files = len(paths) + len(described)
    sources, adfs = read_sources(paths, report), read_sources(described, report)
    if report.has_errors:
        return System(name), files
    if format_ == "scxml":
        return import_scxml(sources, adfs, name, report, known, guesses), files
    category: Literal["abstraction", "swarm"] = "swarm" if format_ == "amf" else "abstraction"
    return import_adf(sources, name, report, category, guesses), files


def read_sources(paths: Sequence[Path], report: Diagnostics) -> list[Source]:
    """Read each readable file."""
    sources = (read_source(path, None, report, "a file", MOST_DATA) for path in paths)
    return [source for source in sources if source is not None]


def package_of(path: Path) -> str:
    """Package name of a model, from the name of its file or origin."""
    name = snake_case(path.absolute().name.partition(".")[0])
    return name if name[:1].isalpha() else f"model_{name}".rstrip("_")
