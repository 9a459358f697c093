"""Results of a test file."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.testing.case import InvalidTest
from swarmdsl.execution.testing.verdict import Verdict


@dataclass
class FileOutcome:
    """Verdicts on the tests of a file, each with its diagnostics.

    `problems` are errors in the file or its model; if they prevent it from being `read`, there are
    no verdicts. Errors of a model are reported with its first test file. Tests with errors of
    their own are `unread`; their errors are in `problems` too.
    """

    path: Path
    read: bool = True
    problems: tuple[Diagnostic, ...] = ()
    unread: tuple[InvalidTest, ...] = ()
    verdicts: list[tuple[Verdict, tuple[Diagnostic, ...]]] = field(default_factory=list)

    @property
    def passed(self) -> bool:
        """True if all tests were run and passed."""
        passed = all(verdict.passed for verdict, _ in self.verdicts)
        return self.read and not self.unread and passed

    @property
    def seconds(self) -> float:
        """Duration of the tests."""
        return sum(verdict.seconds for verdict, _ in self.verdicts)

    @property
    def remarks(self) -> list[str]:
        """Remarks on properties that say nothing of any run in which a test claims them."""
        found: dict[str, list[str]] = {}
        for verdict, _ in self.verdicts:
            for property_, _ in verdict.case.properties:
                remark = verdict.remarks.get(property_.name, "")
                found.setdefault(property_.name, []).append(remark)
        return [
            f"property `{name}`: {remarks[0]} in these tests"
            for name, remarks in found.items()
            if all(remarks)
        ]
