"""`swarmc import`: from files of other tools to one model on disk or standard output."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Literal

from swarmdsl.base.atomic_write import Staging
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.rewriting import Layout
from swarmdsl.driver.format_files import write as write_layouts
from swarmdsl.importing.files import package_of, read_files
from swarmdsl.importing.ros import import_ros, library_functions
from swarmdsl.importing.text import checked, text_of
from swarmdsl.importing.update import Guess
from swarmdsl.importing.update.on_disk import read_existing, updated

Format = Literal["scxml", "adf", "amf", "ros"]
# What a package of ROS does not say of the functions in it.
_OF_FUNCTIONS = ("communication", "category")


@dataclass(frozen=True)
class Imported:
    """What came of an import: the text of a model, or what becomes of the files of one.

    `layouts` are those of the files that change; `is_new` says that there was no such file.
    """

    report: Diagnostics
    files: int
    text: str | None = None
    layouts: Sequence[Layout] = ()
    is_new: bool = True


def run(
    format_: Format,
    paths: Sequence[Path],
    described: Sequence[Path],
    out: Path | None,
    *,
    force: bool,
    dry_run: bool = False,
) -> Imported:
    """Read the files and write the model, or update it where it exists.

    Nothing is written where the check of it would find an error, or in a dry run.
    """
    report = Diagnostics()
    existing = read_existing(out, report) if out is not None else None
    name = package_of(out or paths[0])
    guesses: set[Guess] = set()
    if format_ == "ros":
        functions = library_functions() | (existing.functions() if existing is not None else {})
        system, files = import_ros(paths, name, functions, report)
        guesses.update((each.name, what) for each in system.functions for what in _OF_FUNCTIONS)
        guesses.update((each.name, "kind") for each in system.components)
    else:
        known = existing.system if existing is not None and format_ == "scxml" else None
        system, files = read_files(format_, paths, described, name, known, guesses, report)
    text = text_of(system, paths[0], report)
    if text is None:
        return Imported(report, files)
    if existing is not None:
        layouts = updated(existing, text, guesses, report, complete=format_ == "ros", force=force)
        if not (report.has_errors or dry_run):
            write_layouts(layouts, report)
        made = [] if report.has_errors else layouts
        return Imported(report, files, text, made, is_new=False)
    checked(text, out or Path(f"{name}.swarm"), report)
    if report.has_errors:
        return Imported(report, files)
    if out is not None and not dry_run:
        _write(out, text, report)
    layouts = [Layout(str(out), b"", text.encode())] if out is not None else []
    return Imported(report, files, text, layouts)


def _write(out: Path, text: str, report: Diagnostics) -> None:
    try:
        with Staging() as staging:
            # A link stays one: the empty file that it leads to is replaced.
            staging.add(Path(os.path.realpath(out)), text.encode())
            for _ in staging.move_in_place():
                pass
    except OSError as error:
        report.report("cannot-write", path=out.as_posix(), reason=error.strerror or str(error))
