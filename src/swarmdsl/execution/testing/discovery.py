"""Find test files."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import is_folder
from swarmdsl.project.search import found_below

SUFFIX = ".swarmtest.toml"


def test_files(paths: Iterable[Path], report: Diagnostics) -> list[Path]:
    """Return the named test files and those in named folders; report missing ones."""
    found: dict[str, Path] = {}
    for path in paths:
        if not is_folder(path):
            if path.name.endswith(".toml") or not os.path.lexists(path):
                found.setdefault(os.path.realpath(path), path)
            else:
                report.report(
                    "not-a-file",
                    path=path,
                    actual=f"a {path.suffix or 'nameless'} file",
                    expected=f"a test file, *{SUFFIX}",
                    help="name its folder: the tests are beside the model",
                )
            continue
        inside = found_below(path, SUFFIX, report)
        if inside is not None and not inside:
            help_ = f"tests are in files called `NAME{SUFFIX}`"
            report.report("no-tests", path=path, help=help_)
        for each in inside or ():
            found.setdefault(os.path.realpath(each), each)
    return list(found.values())


def selected(name: str, pattern: str | None) -> bool:
    """Return True if the name of a test, with its file, contains the pattern."""
    return pattern is None or pattern.lower() in name.lower()
