"""Whether a test passes: with its seeds, as many of its runs as must."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from functools import partial

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.execution.simulate.trace import Line
from swarmdsl.execution.testing.case import Case
from swarmdsl.execution.testing.run_case import Failure, play

_SHOWN = 8
# A share of 0.9 asks for 9 of 10, in spite of how computers hold 0.9.
_HAIR = 1e-9


@dataclass(frozen=True)
class Verdict:
    """What became of a test: the failures by seed, and the seconds that it took."""

    case: Case
    seeds: tuple[int, ...]
    failures: dict[int, Failure]
    faults: tuple[tuple[str, str], ...]
    seconds: float

    @property
    def passed(self) -> bool:
        """Whether enough of the runs have passed."""
        runs = len(self.seeds)
        return runs - len(self.failures) >= self.case.passing * runs - _HAIR

    def report(self, report: Diagnostics) -> None:
        """Report the first failure where there are too many, and what had no value."""
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
        """How many must pass, where that is not all of them."""
        least = math.ceil(self.case.passing * len(self.seeds) - _HAIR)
        return f", {least} must" if least < len(self.seeds) else ""

    @property
    def last(self) -> Sequence[Line]:
        """What happened before the first failure."""
        return next(iter(self.failures.values())).last if self.failures else ()


def judge(case: Case, seeds: Sequence[int], listener: Callable[[int, Line], None]) -> Verdict:
    """Run a test with each of the seeds."""
    began = time.perf_counter()
    failures: dict[int, Failure] = {}
    faults: dict[tuple[str, str], None] = {}
    for seed in seeds:
        played = play(case, seed, partial(listener, seed))
        faults.update(dict.fromkeys(played.faults))
        if played.failure is not None:
            failures[seed] = played.failure
    return Verdict(case, tuple(seeds), failures, tuple(faults), time.perf_counter() - began)
