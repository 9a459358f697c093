"""What came of a test file."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.testing.case import Unread
from swarmdsl.execution.testing.verdict import Verdict


@dataclass
class FileOutcome:
    """The verdicts on the tests of a file, each with what is said of it.

    `problems` are mistakes in the file or its model; where it could not be `read` for them,
    there are no verdicts. Those of a model are told with the first file that is about it.
    Mistakes in a test alone leave that one `unread`, and are among them too.
    """

    path: Path
    read: bool = True
    problems: tuple[Diagnostic, ...] = ()
    unread: tuple[Unread, ...] = ()
    verdicts: list[tuple[Verdict, tuple[Diagnostic, ...]]] = field(default_factory=list)

    @property
    def is_well(self) -> bool:
        """Whether all of it was run, and has passed."""
        passed = all(verdict.passed for verdict, _ in self.verdicts)
        return self.read and not self.unread and passed

    @property
    def seconds(self) -> float:
        """How long the tests took."""
        return sum(verdict.seconds for verdict, _ in self.verdicts)
