"""Search of folders for files of a model; what is too much is reported."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.find_files import TooManyFilesError, files_below
from swarmdsl.base.source import Span


def found_below(
    folder: Path, ending: str, report: Diagnostics, at: Span | None = None
) -> list[Path] | None:
    """Return the files below a folder with an ending; None if there is too much in it."""
    try:
        return files_below(folder, ending)
    except TooManyFilesError as error:
        report_too_many(error, at, report)
    return None


def report_too_many(error: TooManyFilesError, at: Span | None, report: Diagnostics) -> None:
    """Report at `at` a folder that has too much in it."""
    help_ = "name the folders of the model in it"
    report.report("too-many-files", at, path=error.filename, reason=error.strerror, help=help_)
