"""Test results as JUnit XML: a suite per test file and a case per test."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.execution.junit import Case, Remark, Suite, class_name, document
from swarmdsl.execution.simulate.world.line import as_text
from swarmdsl.execution.testing.discovery import SUFFIX
from swarmdsl.execution.testing.outcome import FileOutcome
from swarmdsl.execution.testing.verdict import Verdict


def junit(outcomes: Iterable[FileOutcome]) -> str:
    """Return the file."""
    return document("swarmc test", [_suite(outcome) for outcome in outcomes])


def _suite(outcome: FileOutcome) -> Suite:
    name = outcome.path.as_posix()
    group = class_name(outcome.path, SUFFIX)
    unread = [(each.name, each.problems) for each in outcome.unread]
    if not outcome.read:
        unread = [(name, outcome.problems)]
    cases = [
        Case(title, group, remark=Remark.of("error", problems, "error"))
        for title, problems in unread
    ]
    for verdict, found in outcome.verdicts:
        remark = None
        if not verdict.passed:
            remark = Remark.of("failure", found, more=_last(verdict))
        cases.append(Case(verdict.case.name, group, verdict.seconds, remark))
    return Suite(name, tuple(cases), tuple(outcome.remarks), outcome.seconds)


def _last(verdict: Verdict) -> str:
    return "".join(f"{as_text(line)}\n" for line in verdict.last)
