"""Import files of other tools into a model: `swarmc import`."""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Literal

from swarmdsl.base.atomic_write import Staging
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.rewriting import Layout
from swarmdsl.driver.format_files import write as write_layouts
from swarmdsl.driver.write_bounds import may_write_models
from swarmdsl.importing.files import package_of, read_files
from swarmdsl.importing.ros import import_ros, library_functions, why_empty
from swarmdsl.importing.text import check_model, model_text
from swarmdsl.importing.update import Guess
from swarmdsl.importing.update.on_disk import read_existing, update_files

Format = Literal["scxml", "adf", "amf", "ros", "ros2"]
# Properties of functions that ROS packages do not contain.
_GUESSED_OF_FUNCTIONS = ("communication", "category")


@dataclass(frozen=True)
class ImportResult:
    """Result of an import: text of a new model, or changed files of an existing one.

    `layouts` are the changed files; `is_new` is True if the model did not exist.
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
    quiet: float = 0.0,
) -> ImportResult:
    """Import files into a new model, or update an existing one.

    For `ros2`, the path is a namespace of the running ROS 2, which is read until nothing new is
    found for `quiet` seconds.

    Nothing is written in a dry run or if the resulting model has errors.
    """
    report = Diagnostics()
    existing = read_existing(out, report) if out is not None else None
    name = package_of(out or (Path(paths[0].name or "robot") if format_ == "ros2" else paths[0]))
    guesses: set[Guess] = set()
    if format_ == "ros":
        functions = library_functions() | (existing.functions() if existing is not None else {})
        system, files = import_ros(paths, name, functions, report)
        guesses.update(
            (each.name, what) for each in system.functions for what in _GUESSED_OF_FUNCTIONS
        )
        guesses.update((each.name, "kind") for each in system.components)
    elif format_ == "ros2":
        from swarmdsl.importing.ros_graph import import_graph, read_graph

        system, files = import_graph(read_graph(quiet), paths[0].as_posix(), name, report)
        guesses.update((each.name, "category") for each in system.functions)
    else:
        known = existing.system if existing is not None and format_ == "scxml" else None
        system, files = read_files(format_, paths, described, name, known, guesses, report)
    why = partial(why_empty, paths) if format_ == "ros" else lambda: None
    text = model_text(system, paths[0], report, why)
    if text is None:
        return ImportResult(report, files)
    if existing is not None:
        layouts = update_files(
            existing, text, guesses, report, complete=format_ == "ros", force=force
        )
        names = [layout.name for layout in layouts]
        may_write = not report.has_errors and may_write_models(names, [existing.path], report)
        if may_write and not dry_run:
            write_layouts(layouts, report)
        made = [] if report.has_errors else layouts
        return ImportResult(report, files, text, made, is_new=False)
    check_model(text, out or Path(f"{name}.swarm"), report)
    if report.has_errors:
        return ImportResult(report, files)
    if out is not None and not dry_run:
        _write(out, text, report)
    layouts = [Layout(str(out), b"", text.encode())] if out is not None else []
    return ImportResult(report, files, text, layouts)


def _write(out: Path, text: str, report: Diagnostics) -> None:
    try:
        with Staging() as staging:
            # Keep a symbolic link and replace its target, which is empty.
            staging.add(Path(os.path.realpath(out)), text.encode())
            for _ in staging.move_in_place():
                pass
    except OSError as error:
        report.report("cannot-write", path=out.as_posix(), reason=error.strerror or str(error))
