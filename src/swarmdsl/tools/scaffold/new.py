"""`swarmc new`: a project from a plan to files on disk."""

from __future__ import annotations

import os
from pathlib import Path

from swarmdsl.base.atomic_write import Staging
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.tools.scaffold.plan import Plan, check_plan
from swarmdsl.tools.scaffold.project import project_files


@dataclass(frozen=True)
class Created:
    """What came of it: the folder, and the files in it that were written."""

    report: Diagnostics
    folder: Path
    written: tuple[Path, ...] = ()


def create(plan: Plan, folder: Path, *, dry_run: bool = False) -> Created:
    """Write a project to a folder that is new or empty; nothing where the plan has mistakes."""
    report = Diagnostics()
    check_plan(plan, report)
    if is_taken(folder):
        way = "choose another name, or another folder with `--folder`"
        report.report("already-there", path=folder.as_posix(), help=way)
    if report.has_errors:
        return Created(report, folder)
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
            return Created(report, folder)
    return Created(report, folder, tuple(files))


def is_taken(folder: Path) -> bool:
    """Whether no project can go there: something is in the way that is no empty folder."""
    return os.path.lexists(folder) and not _is_empty_folder(folder)


def _is_empty_folder(path: Path) -> bool:
    try:
        return path.is_dir() and not os.listdir(path)  # noqa: PTH208 - the first is enough
    except OSError:
        return False
