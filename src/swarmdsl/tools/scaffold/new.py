"""Create the files of a project: `swarmc new`."""

from __future__ import annotations

import os
from pathlib import Path

from swarmdsl.base.atomic_write import Staging
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import is_folder
from swarmdsl.base.records import dataclass
from swarmdsl.tools.scaffold.plan import Plan, check_plan
from swarmdsl.tools.scaffold.project import project_files


@dataclass(frozen=True)
class Creation:
    """Result of `create`: the project folder and the files written to it."""

    report: Diagnostics
    folder: Path
    written: tuple[Path, ...] = ()


def create(plan: Plan, folder: Path, *, dry_run: bool = False) -> Creation:
    """Write a project to a new or free folder; write nothing if the plan has errors."""
    report = Diagnostics()
    check_plan(plan, report)
    if is_taken(folder):
        hint = "choose another name, or another folder with `--folder`"
        report.report("already-there", path=folder.as_posix(), help=hint)
    if report.has_errors:
        return Creation(report, folder)
    files = {folder / path: text.encode() for path, text in project_files(plan)}
    if not dry_run:
        try:
            with Staging() as staging:
                for path, content in files.items():
                    staging.add(path, content)
                for _ in staging.move_in_place():
                    pass
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            report.report("cannot-write", path=error.filename or str(folder), reason=reason)
            return Creation(report, folder)
    return Creation(report, folder, tuple(files))


def is_taken(folder: Path) -> bool:
    """Return True if something other than a free folder exists there.

    A folder with hidden files of tools, such as `.git` and `.vscode`, is free.
    """
    return os.path.lexists(folder) and not _is_free_folder(folder)


def _is_free_folder(path: Path) -> bool:
    try:
        return is_folder(path) and all(
            each.name.startswith(".") and each.name != ".gitignore" for each in path.iterdir()
        )
    except OSError:
        return False
