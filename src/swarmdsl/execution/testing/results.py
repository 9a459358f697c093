"""Stream of results for programs: a JSON object a line, while tests run."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TextIO

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.execution.simulate.evaluation.coverage import Coverage
from swarmdsl.execution.testing import records
from swarmdsl.execution.testing.case import Case, InvalidTest
from swarmdsl.execution.testing.outcome import FileOutcome
from swarmdsl.execution.testing.outline import Outlined
from swarmdsl.execution.testing.verdict import Verdict


class Results:
    """Write records to a stream, each at once: a reader shows progress."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def file(self, outcome: FileOutcome) -> None:
        """Begin a file."""
        self.write(records.file_record(outcome.path, outcome.read, outcome.problems))

    def started(self, path: Path, name: str, case: Case) -> None:
        """Write that a test starts."""
        self.write(records.started_record(path, name, case))

    def unread(
        self, path: Path, name: str, case: InvalidTest | Outlined, problems: Sequence[Diagnostic]
    ) -> None:
        """Write that a test could not run."""
        self.write(records.unread_record(path, name, case, problems))

    def verdict(
        self, path: Path, name: str, verdict: Verdict, problems: Sequence[Diagnostic]
    ) -> None:
        """Write the result of a test."""
        self.write(records.result_record(path, name, verdict, problems))

    def remarks(self, outcome: FileOutcome) -> None:
        """Write remarks after the tests of a file."""
        for text in outcome.remarks:
            self.write({"type": "note", "file": outcome.path.as_posix(), "text": text})

    def coverage(self, coverage: Coverage) -> None:
        """Write the coverage by all tests."""
        for record in records.coverage_records(coverage):
            self.write(record)

    def summary(self, problems: Sequence[Diagnostic], passed: bool) -> None:
        """Write the end, with what is wrong with the run as a whole."""
        self.write(records.end_record(problems, passed))

    def write(self, record: records.Record) -> None:
        """Write a record."""
        self._stream.write(json.dumps(record) + "\n")
        self._stream.flush()
