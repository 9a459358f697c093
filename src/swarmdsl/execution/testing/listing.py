"""List tests without running them: `swarmc test --list`."""

from __future__ import annotations

from typing import TextIO

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.diagnostics.render import render
from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.execution.testing.case import Case
from swarmdsl.execution.testing.models import Models
from swarmdsl.execution.testing.read_file import ReadFile, read_file
from swarmdsl.execution.testing.records import file_record, listed_record
from swarmdsl.execution.testing.results import Results
from swarmdsl.execution.testing.selection import Selection, chosen_files, id_of, report_missing


def list_tests(
    selection: Selection, pattern: str | None, format_: str, stdout: TextIO, stderr: TextIO
) -> bool:
    """List the tests of files; return True if there are some, without mistakes.

    In format `json`, files and tests are JSON lines like those of results; in other formats for
    programs, the list goes to `stderr`, as results do.
    """
    report = Diagnostics()
    models = Models()
    results = Results(stdout) if format_ == "json" else None
    names = stdout if format_ == "text" else stderr
    found, fine = 0, True
    for path, chosen in chosen_files(selection, report):
        file = read_file(path, models, pattern, chosen)
        if chosen is not None:
            report_missing(path, chosen, file.names, report)
        found += len(file.chosen)
        fine = fine and file.fine
        if results is not None:
            _write(file, results)
            continue
        for name, case in file.chosen:
            subject = f"  ({case.subject.name})" if isinstance(case, Case) else "  (unread)"
            line, _ = case.place.source.line_column(case.place.start)
            names.write(f"{printable(id_of(path, name))}  line {line}{subject}\n")
        report.include(file.problems)
    if not found and not report.has_errors and fine:
        where = " ".join(map(str, (*selection.whole, *selection.named))) or "."
        report.report("no-tests", path=where, help=f"`-k {pattern}` leaves out all")
    names.flush()
    render(report, format_, stderr if format_ == "text" else stdout)
    return fine and not report.has_errors


def _write(file: ReadFile, results: Results) -> None:
    results.write(file_record(file.path, file.read, file.problems))
    for name, case in file.chosen:
        results.write(listed_record(file.path, name, case))
