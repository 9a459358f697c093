"""`swarmc test`: find tests, run them and print the results."""

from __future__ import annotations

import gc
import time
from collections.abc import Callable
from pathlib import Path
from typing import TextIO

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import MOST_DATA
from swarmdsl.base.records import dataclass
from swarmdsl.base.write_stream import write_stream
from swarmdsl.execution.simulate.coverage import Coverage
from swarmdsl.execution.simulate.trace import Line
from swarmdsl.execution.testing.case import InvalidTest
from swarmdsl.execution.testing.console import Console
from swarmdsl.execution.testing.discovery import selected, test_files
from swarmdsl.execution.testing.junit import junit
from swarmdsl.execution.testing.models import Models
from swarmdsl.execution.testing.outcome import FileOutcome
from swarmdsl.execution.testing.reading import read_tests
from swarmdsl.execution.testing.verdict import Verdict, judge
from swarmdsl.project.read_source import read_source


@dataclass(frozen=True)
class Request:
    """Arguments of the command."""

    paths: tuple[Path, ...]
    pattern: str | None = None
    seed: int | None = None
    junit: Path | None = None
    trace: bool = False
    coverage: bool = False
    fail_under: float | None = None
    format: str = "text"
    show: Callable[[Verdict], object] | None = None
    """Gets the verdict on the first test that fails."""


def run(request: Request, stdout: TextIO, stderr: TextIO) -> bool:
    """Run the tests; return True if all pass."""
    # The compiler disables garbage collection, but a run may be long.
    gc.enable()
    return _Session(request, stdout, stderr).run()


class _Session:
    def __init__(self, request: Request, stdout: TextIO, stderr: TextIO) -> None:
        self._request = request
        self._console = Console(stdout, stderr, request.format)
        self._models = Models()
        self._coverage = Coverage()
        self._outcomes: list[FileOutcome] = []
        self._left_out = 0
        self._show = request.show

    def run(self) -> bool:
        began = time.perf_counter()
        report = Diagnostics()
        paths = test_files(self._request.paths or (Path(),), report)
        try:
            for path in paths:
                self._file(path)
        except KeyboardInterrupt:
            self._tell(report, began)
            raise
        self._finish(report)
        self._tell(report, began)
        return not report.has_errors and all(outcome.passed for outcome in self._outcomes)

    def _tell(self, report: Diagnostics, began: float) -> None:
        for outcome in self._outcomes:
            for verdict, found in outcome.verdicts:
                self._console.findings(verdict, found)
        if self._request.coverage or self._request.fail_under is not None:
            self._console.coverage(self._coverage)
        self._console.problems(report)
        self._console.summary(self._outcomes, self._left_out, time.perf_counter() - began)

    def _file(self, path: Path) -> None:
        report = Diagnostics()
        source = read_source(path, None, report, most=MOST_DATA)
        tests = read_tests(source, self._models, report) if source is not None else None
        cases = tests.cases if tests is not None else ()
        chosen = [c for c in cases if selected(f"{path.as_posix()}::{c.name}", self._pattern)]
        self._left_out += len(cases) - len(chosen)
        unread = tuple(case for case in chosen if isinstance(case, InvalidTest))
        report.include(problem for case in unread for problem in case.problems)
        outcome = FileOutcome(path, tests is not None, tuple(report), unread)
        if cases and not chosen:
            return
        self._outcomes.append(outcome)
        self._console.file(outcome)
        for case in chosen:
            if isinstance(case, InvalidTest):
                self._console.unread(case)
                continue
            self._coverage.expect(case.subject)
            seeds = case.seeds if self._request.seed is None else (self._request.seed,)
            verdict = judge(case, seeds, self._listen)
            self._console.verdict(verdict)
            found = Diagnostics()
            verdict.report(found)
            outcome.verdicts.append((verdict, tuple(found)))
            if not verdict.passed and self._show is not None:
                self._show(verdict)
                self._show = None
        self._console.remarks(outcome)

    @property
    def _pattern(self) -> str | None:
        return self._request.pattern

    def _listen(self, seed: int, line: Line) -> None:
        self._coverage.see(line)
        if self._request.trace:
            self._console.trace(seed, line)

    def _finish(self, report: Diagnostics) -> None:
        """Check the results that depend on all tests."""
        request = self._request
        if self._left_out and not self._outcomes:
            help_ = f"`-k {request.pattern}` leaves out all {self._left_out}"
            report.report("no-tests", path=" ".join(map(str, request.paths)) or ".", help=help_)
        reached = self._coverage.percentage
        if request.fail_under is not None and reached < request.fail_under:
            report.report(
                "low-coverage", reached=f"{reached:.1f}", wanted=f"{request.fail_under:g}"
            )
        if request.junit is not None:
            try:
                with write_stream(request.junit) as stream:
                    stream.write(junit(self._outcomes))
            except OSError as error:
                reason = str(error.strerror or error).lower()
                report.report("cannot-write", path=request.junit, reason=reason)
