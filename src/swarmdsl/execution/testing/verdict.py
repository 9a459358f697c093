"""Verdict on a test, from its runs with all seeds."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from functools import partial

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.testing.case import Case
from swarmdsl.execution.testing.run_case import run_case
from swarmdsl.execution.testing.run_result import Failure, RunResult

_SHOWN = 8
# Tolerance for rounding: a share of 0.9 means 9 of 10.
_HAIR = 1e-9


@dataclass(frozen=True)
class Verdict:
    """Result of a test: failures by seed, and its duration in seconds.

    `remarks` are about properties that say nothing of any of its runs.
    """

    case: Case
    seeds: tuple[int, ...]
    failures: dict[int, Failure]
    faults: tuple[tuple[str, str], ...]
    seconds: float
    remarks: Mapping[str, str]
    skipped: int = 0
    """Number of impossible actions that were left out, at most in one run."""

    @property
    def passed(self) -> bool:
        """True if enough runs passed."""
        runs = len(self.seeds)
        return runs - len(self.failures) >= self.case.passing * runs - _HAIR

    def report(self, report: Diagnostics) -> None:
        """Report the first failure if too many runs failed, and failed expressions."""
        for machine, reason in self.faults:
            note = f"in the test `{self.case.name}`"
            report.report("failed-expression", machine=machine, reason=reason, notes=(note,))
        if self.passed:
            return
        seed, failure = next(iter(self.failures.items()))
        report.report(
            failure.code,
            failure.place,
            label=failure.label,
            related=failure.related,
            notes=tuple(self._notes(seed)),
            **failure.fields,
        )

    def _notes(self, seed: int) -> list[str]:
        notes = [f"in the test `{self.case.name}`"]
        runs = len(self.seeds)
        if runs > 1:
            failed = [str(each) for each in self.failures]
            more = ["..."] if len(failed) > _SHOWN else []
            notes.append(
                f"{runs - len(failed)} of {runs} seeds pass{self._wanted}; it fails with "
                f"{', '.join([*failed[:_SHOWN], *more])}"
            )
            notes.append(f"this is how it fails with `--seed {seed}`")
        return notes

    @property
    def _wanted(self) -> str:
        """Required number of passing runs, if not all."""
        least = math.ceil(self.case.passing * len(self.seeds) - _HAIR)
        return f", {least} must" if least < len(self.seeds) else ""

    @property
    def last(self) -> Sequence[Line]:
        """Trace lines before the first failure."""
        return next(iter(self.failures.values())).last if self.failures else ()


def judge(case: Case, seeds: Sequence[int], listener: Callable[[int, Line], None]) -> Verdict:
    """Run a test with each seed."""
    return judge_runs(case, seeds, lambda seed: run_case(case, seed, partial(listener, seed)))


def judge_runs(case: Case, seeds: Sequence[int], play: Callable[[int], RunResult]) -> Verdict:
    """Return the verdict on a test from the results of its runs."""
    began = time.perf_counter()
    failures: dict[int, Failure] = {}
    faults: dict[tuple[str, str], None] = {}
    remarks: list[Mapping[str, str]] = []
    skipped = 0
    for seed in seeds:
        played = play(seed)
        faults.update(dict.fromkeys(played.faults))
        remarks.append(played.remarks)
        skipped = max(skipped, played.skipped)
        if played.failure is not None:
            failures[seed] = played.failure
    silent = {
        name: remark
        for name, remark in (remarks[0] if remarks else {}).items()
        if all(name in each for each in remarks)
    }
    seconds = time.perf_counter() - began
    return Verdict(case, tuple(seeds), failures, tuple(faults), seconds, silent, skipped)
