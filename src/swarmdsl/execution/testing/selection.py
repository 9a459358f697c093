"""Ids of tests, `FILE::NAME`, and the tests that arguments of the command line choose by them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import is_folder
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.suggest import did_you_mean
from swarmdsl.execution.testing.discovery import test_files

SEPARATOR = "::"


@dataclass(frozen=True)
class Selection:
    """Chosen files and folders, and the names of single tests by their files."""

    whole: tuple[Path, ...] = ()
    named: Mapping[Path, frozenset[str]] = field(default_factory=dict)


def read_selection(arguments: Iterable[str]) -> Selection:
    """Read files, folders and ids.

    read_selection(["a", "b.toml::one"]) chooses what is in `a`, and the test `one` of `b.toml`.
    """
    whole: list[Path] = []
    named: dict[Path, set[str]] = {}
    for argument in arguments:
        file, name = _split(argument)
        if name is None:
            whole.append(Path(file))
        else:
            named.setdefault(Path(file), set()).add(name)
    return Selection(tuple(whole), {path: frozenset(names) for path, names in named.items()})


def _split(argument: str) -> tuple[str, str | None]:
    """Return the file and the name in an id; a name and a path may have the separator, too."""
    parts = argument.split(SEPARATOR)
    if len(parts) == 1 or os.path.lexists(argument):
        return argument, None
    ways = [
        (SEPARATOR.join(parts[:count]), SEPARATOR.join(parts[count:]))
        for count in range(1, len(parts))
    ]
    there = (way for way in ways if os.path.lexists(way[0]))
    file, name = next(there, ways[0])
    # A folder has no tests of its own: it is reported as a missing file.
    return (argument, None) if is_folder(Path(file)) else (file, name)


def chosen_files(
    selection: Selection, report: Diagnostics
) -> list[tuple[Path, frozenset[str] | None]]:
    """Return the files to read, each with the names of the chosen tests; None means all."""
    whole = selection.whole or (() if selection.named else (Path(),))
    found: list[tuple[Path, frozenset[str] | None]] = [
        (path, None) for path in test_files(whole, report)
    ]
    known = {os.path.realpath(path) for path, _ in found}
    names: dict[str, frozenset[str]] = {}
    for path, some in selection.named.items():
        place = os.path.realpath(path)
        names[place] = names.get(place, frozenset()) | some
    for path in test_files(selection.named, report):
        place = os.path.realpath(path)
        if place not in known:
            found.append((path, names[place]))
    return found


def id_of(path: Path, name: str) -> str:
    """Return the id of a test: "missions/a.swarmtest.toml::it lands"."""
    return f"{path.as_posix()}{SEPARATOR}{name}"


def unique(names: Sequence[str]) -> list[str]:
    """Return the names with numbers for those that an earlier test has: "it lands (2)"."""
    found: dict[str, None] = {}
    for name in names:
        number, free = 1, name
        while free in found:
            number += 1
            free = f"{name} ({number})"
        found[free] = None
    return list(found)


def report_missing(
    path: Path, names: Iterable[str], known: Sequence[str], report: Diagnostics
) -> None:
    """Report chosen names of tests that a file does not have."""
    for name in sorted(set(names).difference(known)):
        help_ = did_you_mean(name, known) or "`swarmc test --list` shows the tests"
        report.report("no-tests", path=id_of(path, name), help=help_)
