"""`swarmc test`: find tests, run them and print the results."""

from __future__ import annotations

import gc
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import TextIO

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.write_stream import report_unwritten, write_stream
from swarmdsl.execution.simulate.evaluation.coverage import Coverage
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.testing.case import Case, InvalidTest
from swarmdsl.execution.testing.console import Console
from swarmdsl.execution.testing.models import Models
from swarmdsl.execution.testing.outcome import FileOutcome
from swarmdsl.execution.testing.read_file import read_file
from swarmdsl.execution.testing.results import Results
from swarmdsl.execution.testing.selection import Selection, chosen_files, report_missing
from swarmdsl.execution.testing.verdict import Verdict, judge

STDOUT = Path("-")
"""Results on standard output."""


@dataclass(frozen=True)
class Request:
    """Arguments of the command."""

    paths: tuple[Path, ...] = ()
    named: Mapping[Path, frozenset[str]] = field(default_factory=dict)
    """Names of single tests by their files."""
    pattern: str | None = None
    seed: int | None = None
    junit: Path | None = None
    results: Path | None = None
    trace: bool = False
    coverage: bool = False
    fail_under: float | None = None
    format: str = "text"
    show: Callable[[Verdict], object] | None = None
    """Gets the verdict on the first test that fails, or on the only one."""


def run(request: Request, stdout: TextIO, stderr: TextIO) -> bool:
    """Run the tests; return True if all pass."""
    # The compiler disables garbage collection, but a run may be long.
    gc.enable()
    return _Session(request, stdout, stderr).run()


class _Session:
    def __init__(self, request: Request, stdout: TextIO, stderr: TextIO) -> None:
        self._request = request
        # Results on standard output leave it to programs.
        shown = stderr if request.results == STDOUT else stdout
        self._console = Console(shown, stderr, request.format)
        self._stdout = stdout
        self._results: Results | None = None
        self._models = Models()
        self._coverage = Coverage()
        self._outcomes: list[FileOutcome] = []
        self._left_out = 0
        self._show = request.show

    def run(self) -> bool:
        began = time.perf_counter()
        report = Diagnostics()
        with self._stream(report):
            selection = Selection(self._request.paths, self._request.named)
            try:
                for path, names in chosen_files(selection, report):
                    self._file(path, names, report)
            except KeyboardInterrupt:
                self._tell(report, began)
                raise
            self._finish(report)
            self._tell(report, began)
            passed = all(outcome.passed for outcome in self._outcomes)
            passed = passed and not report.has_errors
            if self._results is not None:
                if self._request.coverage:
                    self._results.coverage(self._coverage)
                self._results.summary(tuple(report), passed)
        return passed

    @contextmanager
    def _stream(self, report: Diagnostics) -> Iterator[None]:
        """Open the file of the results for the time of the run."""
        path = self._request.results
        if path is None:
            yield
            return
        try:
            opened = nullcontext(self._stdout) if path == STDOUT else write_stream(path)
        except OSError as error:
            report_unwritten(path, error, report)
            yield
            return
        with opened as stream:
            self._results = Results(stream)
            yield

    def _tell(self, report: Diagnostics, began: float) -> None:
        for outcome in self._outcomes:
            for verdict, found in outcome.verdicts:
                self._console.findings(verdict, found)
        if self._request.coverage or self._request.fail_under is not None:
            self._console.coverage(self._coverage)
        self._console.problems(report)
        self._console.summary(self._outcomes, self._left_out, time.perf_counter() - began)

    def _file(self, path: Path, names: frozenset[str] | None, report: Diagnostics) -> None:
        file = read_file(path, self._models, self._request.pattern, names)
        if names is not None:
            report_missing(path, names, file.names, report)
        if file.read:
            self._left_out += len(file.names) - len(file.chosen)
            if file.names and not file.chosen:
                return
        outcome = FileOutcome(path, file.read, file.problems, file.unread)
        self._outcomes.append(outcome)
        self._console.file(outcome)
        if self._results is not None:
            self._results.file(outcome)
        for name, case in file.chosen:
            if isinstance(case, Case):
                self._case(path, name, case, outcome)
                continue
            problems = case.problems if isinstance(case, InvalidTest) else file.problems
            if self._results is not None:
                self._results.unread(path, name, case, problems)
            if isinstance(case, InvalidTest):
                self._console.unread(case)
        self._console.remarks(outcome)
        if self._results is not None:
            self._results.remarks(outcome)

    def _case(self, path: Path, name: str, case: Case, outcome: FileOutcome) -> None:
        """Run a test."""
        if self._results is not None:
            self._results.started(path, name, case)
        self._coverage.expect(case.subject)
        seeds = case.seeds if self._request.seed is None else (self._request.seed,)
        verdict = judge(case, seeds, self._listen)
        self._console.verdict(verdict)
        found = Diagnostics()
        verdict.report(found)
        outcome.verdicts.append((verdict, tuple(found)))
        if self._results is not None:
            self._results.verdict(path, name, verdict, tuple(found))
        if not verdict.passed and self._show is not None:
            self._show(verdict)
            self._show = None

    def _listen(self, seed: int, line: Line) -> None:
        self._coverage.see(line)
        if self._request.trace:
            self._console.trace(seed, line)

    def _finish(self, report: Diagnostics) -> None:
        """Check the results that depend on all tests."""
        request = self._request
        verdicts = [verdict for outcome in self._outcomes for verdict, _ in outcome.verdicts]
        if self._show is not None and len(verdicts) == 1:
            self._show(verdicts[0])
        if request.pattern is not None and self._left_out and not self._outcomes:
            help_ = f"`-k {request.pattern}` leaves out all {self._left_out}"
            where = " ".join(map(str, (*request.paths, *request.named))) or "."
            report.report("no-tests", path=where, help=help_)
        reached = self._coverage.percentage
        if request.fail_under is not None and reached < request.fail_under:
            report.report(
                "low-coverage", reached=f"{reached:.1f}", wanted=f"{request.fail_under:g}"
            )
        if request.junit is not None:
            from swarmdsl.execution.testing.junit import junit  # needs lxml

            try:
                with write_stream(request.junit) as stream:
                    stream.write(junit(self._outcomes))
            except OSError as error:
                reason = str(error.strerror or error).lower()
                report.report("cannot-write", path=request.junit, reason=reason)
