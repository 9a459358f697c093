"""File of behaviour tests that show what is wrong, each of which was run and fails."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

from swarmdsl.base.diagnostics.collector import Diagnostics, Severity
from swarmdsl.base.naming import fresh
from swarmdsl.base.read_files import MOST_DATA
from swarmdsl.base.records import replace
from swarmdsl.base.source import Source
from swarmdsl.driver.config.toml import parse_toml
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import MICROSECOND, SECOND
from swarmdsl.execution.verify.automata.limits import Budget
from swarmdsl.execution.verify.proofs.verdict import at_limit
from swarmdsl.execution.verify.report.saved_test import ReplayedTest, Setting
from swarmdsl.execution.verify.report.shown import Shown, Unshown
from swarmdsl.execution.verify.report.toml_text import toml_text
from swarmdsl.execution.verify.search.run import Run
from swarmdsl.project.read_source import read_source

if TYPE_CHECKING:
    from swarmdsl.execution.testing.models import Models

_HEAD = """\
# Written by `swarmc verify --save-test`. Each test fails until the model is mended, and then says
# that it stays so.
"""
_OTHERWISE = "its test passes: what happens at one time may have another order in it"
_MOST_NAMES = 5
"""Maximum number of names of tests for which there was no time."""


class TestFile:
    """Tests for a path, added one by one until a budget ends, under a scenario if one is given."""

    def __init__(
        self,
        subject: Subject,
        models: Sequence[Path],
        path: Path,
        scenario: Path | None,
        budget: Budget,
    ) -> None:
        # Most calls of the command write no test, and need not wait for this.
        from swarmdsl.execution.testing.models import Models

        self._subject = subject
        self._models = models
        self._path = path
        self._params = _params(scenario) if scenario is not None else {}
        self._budget = budget
        self._compiled = Models()
        self._tests: list[str] = []
        self._names: dict[str, None] = {}
        self._not_shown: dict[str, str] = {}
        """Names of what tests cannot show, with the reasons."""
        self._unsaved: dict[str, None] = {}
        """Names of what there was no time for."""

    def add(self, found: Shown | Unshown, silent: Sequence[str]) -> None:
        """Add a test if one fails that replays a run.

        Functions that are `silent` may not answer in it.
        """
        if isinstance(found, Unshown):
            self._not_shown.setdefault(found.name, found.reason)
            return
        if not self._budget.spares_a_moment():
            self._unsaved[found.name] = None
            return
        # Robots may wait in one state for several reasons.
        found = replace(found, name=fresh(found.name, self._names, gap=" "))
        self._names[found.name] = None
        setting = Setting(self._params, tuple(silent))
        reason = ""
        for run, early in product(_with_laps(found.run), (0, MICROSECOND)):
            replayed = ReplayedTest(self._subject, replace(found, run=run), setting, early)
            test = "".join(f"{line}\n" for line in replayed.lines())
            reason = _flaw(self._with([test]), self._path, self._compiled)
            if not reason:
                self._tests.append(test)
                return
        self._not_shown[found.name] = reason

    def left_out(self) -> Iterator[str]:
        """Yield lines about what is not in the file."""
        for name, reason in self._not_shown.items():
            yield f"not written as a test: {name}: {reason}"
        names = list(self._unsaved)
        if names:
            rest = f" and {len(names) - _MOST_NAMES} more" if len(names) > _MOST_NAMES else ""
            told = f"{', '.join(names[:_MOST_NAMES])}{rest}"
            yield f"not written as a test: {told}: {at_limit(self._budget)}"

    def text(self) -> str:
        """Return the text of the file, or "" if there is no test."""
        return self._with(self._tests) if self._tests else ""

    def _with(self, tests: Sequence[str]) -> str:
        folder = self._path.parent.absolute()
        named = [Path(os.path.relpath(each.absolute(), folder)).as_posix() for each in self._models]
        kind = "swarm" if self._subject.swarm is not None else "machine"
        head = [
            _HEAD,
            f"model = {toml_text(named[0] if len(named) == 1 else named)}\n",
            f"{kind} = {toml_text(self._subject.name)}\n",
            'impossible = "skip"  # a mended model may run otherwise\n',
        ]
        return "".join([*head, *(f"\n{test}" for test in tests)])


def _params(scenario: Path) -> Mapping[str, Any]:
    """Return the params of a scenario, as they are written there."""
    source = read_source(scenario, None, Diagnostics(), "a scenario", MOST_DATA)
    document = parse_toml(source, Diagnostics()) if source is not None else None
    return document.values.get("params", {}) if document is not None else {}


def _with_laps(run: Run) -> Iterator[Run]:
    """Yield a run with laps of a second at least, if time may pass in them, and as it is."""
    if 0 < run.period < SECOND:
        yield replace(run, period=SECOND)
    yield run


def _flaw(text: str, path: Path, compiled: Models) -> str:
    """Return why the only test of a file does not fail as it should, else an empty string."""
    from swarmdsl.execution.testing.case import InvalidTest
    from swarmdsl.execution.testing.reading import read_tests
    from swarmdsl.execution.testing.verdict import judge

    report = Diagnostics()
    tests = read_tests(Source(path.as_posix(), text, path), compiled, report)
    for case in tests.cases if tests is not None else ():
        if isinstance(case, InvalidTest):
            report.include(case.problems)
        elif not judge(case, case.seeds, lambda _seed, _line: None).passed:
            return ""
    error = next((each.message for each in report if each.severity is Severity.ERROR), None)
    return error or _OTHERWISE
