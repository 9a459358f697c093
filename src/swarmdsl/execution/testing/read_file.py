"""Read a test file and choose tests of it, with what is wrong with them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics
from swarmdsl.base.read_files import MOST_DATA
from swarmdsl.base.records import dataclass
from swarmdsl.execution.testing.case import Case, InvalidTest
from swarmdsl.execution.testing.discovery import selected
from swarmdsl.execution.testing.models import Models
from swarmdsl.execution.testing.outline import Outlined, outline
from swarmdsl.execution.testing.reading import read_tests
from swarmdsl.execution.testing.selection import id_of, unique
from swarmdsl.project.read_source import read_source


@dataclass(frozen=True)
class ReadFile:
    """A test file: the names of all its tests, and the chosen ones.

    If mistakes keep it from being `read`, its tests are known by names and places only. `problems`
    are those of the file, and of the chosen tests that cannot run.
    """

    path: Path
    read: bool
    names: Sequence[str]
    chosen: Sequence[tuple[str, Case | InvalidTest | Outlined]]
    problems: tuple[Diagnostic, ...]

    @property
    def unread(self) -> tuple[InvalidTest, ...]:
        """Chosen tests that cannot run."""
        return tuple(case for _, case in self.chosen if isinstance(case, InvalidTest))

    @property
    def fine(self) -> bool:
        """True if all chosen tests can run."""
        return self.read and not self.unread


def read_file(
    path: Path, models: Models, pattern: str | None, chosen: frozenset[str] | None
) -> ReadFile:
    """Read the tests of a file that have the pattern and one of the chosen names."""
    report = Diagnostics()
    source = read_source(path, None, report, most=MOST_DATA)
    tests = read_tests(source, models, report) if source is not None else None
    cases: Sequence[Case | InvalidTest | Outlined] = ()
    if tests is not None:
        cases = tests.cases
    elif source is not None:
        cases = outline(source)
    names = unique([case.name for case in cases])
    kept = [
        (name, case)
        for name, case in zip(names, cases, strict=True)
        if (chosen is None or name in chosen) and selected(id_of(path, case.name), pattern)
    ]
    if tests is not None:
        invalid = (case for _, case in kept if isinstance(case, InvalidTest))
        report.include(problem for case in invalid for problem in case.problems)
    return ReadFile(path, tests is not None, names, kept, tuple(report))
