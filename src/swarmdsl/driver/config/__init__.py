"""Project file `swarm.toml`: defaults for the command line."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import MOST_DATA, is_file
from swarmdsl.base.source import Source
from swarmdsl.driver.config.settings import FILE_NAME, ModelSource, Settings
from swarmdsl.project.read_source import read_source


def find_settings(paths: Sequence[Path], report: Diagnostics) -> Settings:
    """Return the settings for files and folders; defaults without a project file.

    Incomplete if errors were reported.
    """
    path = find_file(paths[0] if paths else Path())
    return read_project(path, report) if path is not None else Settings()


def read_project(path: Path, report: Diagnostics, source: Source | None = None) -> Settings:
    """Read a project file, or `source` in its place.

    Incomplete if errors were reported.
    """
    # Imported here because the TOML parser is slow to import.
    from swarmdsl.driver.config.schema import read_settings
    from swarmdsl.driver.config.toml import parse_toml

    source = source or read_source(path, None, report, most=MOST_DATA)
    document = parse_toml(source, report) if source is not None else None
    return read_settings(document, path.parent, report) if document is not None else Settings()


def find_file(start: Path) -> Path | None:
    """Find the project file in the folder of `start` or the closest one above."""
    for found in places(start):
        if is_file(found):
            return Path(found if start.is_absolute() else os.path.relpath(found))
    return None


def places(start: Path) -> Iterator[str]:
    """Yield the candidate paths of the project file, the closest first."""
    # As a string: the argument may not be a path that the system can look up.
    absolute = os.path.abspath(start)  # noqa: PTH100
    for folder in (Path(absolute), *Path(absolute).parents):
        yield os.path.join(folder, FILE_NAME)  # noqa: PTH118


__all__ = [
    "FILE_NAME",
    "ModelSource",
    "Settings",
    "find_file",
    "find_settings",
    "places",
    "read_project",
]
