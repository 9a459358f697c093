"""Console output of tests: a line per test, failures and a summary."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import TextIO

import click

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.base.diagnostics.render import DOCUMENTS, counted, render
from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.execution.simulate.evaluation.coverage import Coverage, MachineCoverage
from swarmdsl.execution.simulate.world.line import Line, as_text
from swarmdsl.execution.testing.case import InvalidTest
from swarmdsl.execution.testing.outcome import FileOutcome
from swarmdsl.execution.testing.verdict import Verdict

_COLOURS = {"ok": "green", "FAILED": "red", "unread": "red", "note": "cyan"}


class Console:
    """Write results and failures to `stdout`, the summary to `stderr`.

    In formats for programs, only the failures go to `stdout`: those of a format that is one
    document at the end.
    """

    def __init__(self, stdout: TextIO, stderr: TextIO, format_: str) -> None:
        self._results = stdout if format_ == "text" else stderr
        self._stream = stdout
        self._summary = stderr
        self._format = format_
        self._kept: list[Diagnostic] = []
        """Diagnostics of the document at the end."""

    def file(self, outcome: FileOutcome) -> None:
        """Begin a file, with its errors."""
        self._say(printable(outcome.path.as_posix()))
        if not outcome.read and not outcome.problems:
            self._say("  not run: the model has errors")
        self._flush()
        self._render(outcome.problems)

    def verdict(self, verdict: Verdict) -> None:
        """Print the result of a test."""
        name = verdict.case.name
        runs = len(verdict.seeds)
        if runs > 1:
            name += f" ({runs - len(verdict.failures)} of {runs} seeds)"
        if verdict.skipped:
            name += f" ({counted(verdict.skipped, 'impossible action')} skipped)"
        self._test("ok" if verdict.passed else "FAILED", name)

    def unread(self, case: InvalidTest) -> None:
        """Print a test that could not run; its errors are printed with the file."""
        self._test("unread", case.name)

    def remarks(self, outcome: FileOutcome) -> None:
        """Print remarks after the tests of a file."""
        for remark in outcome.remarks:
            self._test("note", remark)

    def trace(self, seed: int, line: Line) -> None:
        """Print a trace line with its seed."""
        self._say(f"    seed {seed} {printable(as_text(line))}")

    def problems(self, found: Iterable[Diagnostic]) -> None:
        """Print diagnostics about the whole run."""
        self._flush()
        self._render(found)

    def findings(self, verdict: Verdict, found: Sequence[Diagnostic]) -> None:
        """Print the failure of a test; for people, with the last trace lines."""
        if not found:
            return
        self._flush()
        if self._format == "text":
            self._stream.write("\n")
        self._render(found)
        if self._format == "text" and not verdict.passed:
            self._stream.write("the last trace lines:\n")
            self._stream.writelines(f"{printable(as_text(line))}\n" for line in verdict.last)

    def coverage(self, coverage: Coverage) -> None:
        """Print the coverage and the unreached elements."""
        rows = [("coverage", "states", "transitions")]
        rows += [_row(each) for each in coverage.machines]
        widths = [max(len(row[column]) for row in rows) for column in range(3)]
        self._say("")
        for number, row in enumerate(rows):
            first, *others = (text.ljust(w) for text, w in zip(row, widths, strict=True))
            self._say("  ".join([first, *others]).rstrip())
            if number:
                for line in coverage.machines[number - 1].missed:
                    self._say(f"  {printable(line)}")
        self._say(f"{int(coverage.percentage)} % of all states and transitions")
        self._flush()

    def summary(self, outcomes: Sequence[FileOutcome], left_out: int, seconds: float) -> None:
        """Print a summary such as "11 passed, 1 failed in 0.41 s"."""
        verdicts = [verdict for outcome in outcomes for verdict, _ in outcome.verdicts]
        failed = sum(not verdict.passed for verdict in verdicts)
        unread = sum(len(outcome.unread) for outcome in outcomes)
        files = sum(not outcome.read for outcome in outcomes)
        parts = [f"{len(verdicts) - failed} passed"]
        parts += [f"{failed} failed"] if failed else []
        parts += [f"{left_out} left out"] if left_out else []
        parts += [f"{counted(unread, 'test')} not read"] if unread else []
        parts += [f"{counted(files, 'file')} not read"] if files else []
        self._flush()
        if self._format in DOCUMENTS:
            render(self._kept, self._format, self._stream)
        self._summary.write(f"{', '.join(parts)} in {seconds:.2f} s\n")

    def _render(self, found: Iterable[Diagnostic]) -> None:
        if self._format in DOCUMENTS:
            self._kept += found
        else:
            render(found, self._format, self._stream)

    def _test(self, word: str, name: str) -> None:
        self._say(f"  {self._coloured(f'{word:<6}', _COLOURS[word])}  {printable(name)}")

    def _say(self, text: str) -> None:
        self._results.write(f"{text}\n")

    def _flush(self) -> None:
        self._results.flush()

    def _coloured(self, text: str, colour: str) -> str:
        wanted = self._results.isatty() or os.environ.get("FORCE_COLOR")
        return click.style(text, fg=colour) if wanted and not os.environ.get("NO_COLOR") else text


def _row(each: MachineCoverage) -> tuple[str, str, str]:
    return (
        each.name,
        _share(len(each.entered), len(each.states)),
        _share(len(each.taken), len(each.transitions)),
    )


def _share(count: int, of: int) -> str:
    return f"{count} of {of}"
