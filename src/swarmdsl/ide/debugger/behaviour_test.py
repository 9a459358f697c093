"""Behaviour test as the program of a debug session."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.simulate.machines.actors import Actor, actors
from swarmdsl.execution.simulate.world.world import World
from swarmdsl.execution.testing.case import Case
from swarmdsl.execution.testing.models import Models
from swarmdsl.execution.testing.read_file import read_file
from swarmdsl.execution.testing.records import Record, result_record, unread_record
from swarmdsl.execution.testing.run_case import run_case
from swarmdsl.execution.testing.run_result import Failure, RunResult
from swarmdsl.execution.testing.selection import chosen_files, read_selection, report_missing
from swarmdsl.execution.testing.verdict import judge_runs
from swarmdsl.ide.debugger.launch_keys import MODEL_KEYS
from swarmdsl.ide.debugger.messages import Arguments, RequestError, as_path, optional, required
from swarmdsl.ide.debugger.programs import Stage, distinct_machines

_SEARCH = 3.0
"""Longest search for a seed that fails, in seconds; the others run when the shown one is over."""


class TestProgram:
    """Runs of one test: one with the stage, those with other seeds unseen.

    On the stage is the first seed with which the test fails, or its first one.
    """

    __test__ = False  # for pytest, which would collect the class

    def __init__(self, path: Path, name: str, case: Case, seeds: Sequence[int]) -> None:
        self.subject = case.subject
        robots = case.subject.create_robots(case.scenario.counts, case.scenario.alone)
        cast = actors(case.subject, robots, case.scenario, Diagnostics())
        self.machines = distinct_machines(cast)
        self._path = path
        self._name = name
        self._case = case
        self._seeds = seeds
        self._unseen: dict[int, RunResult] = {}
        self._shown: int | None = seeds[0] if len(seeds) == 1 else None

    def play(self, stage: Stage) -> str:
        """Run once; return why it is over."""
        if self._shown is None:
            self._shown = self._choose(stage)
        shown = run_case(
            self._case, self._shown, stage.see, _Opened(stage), stage.pace, stage.reach
        )
        if shown.failure is not None:
            stage.fail(_described(shown.failure))
        verdict = judge_runs(
            self._case,
            self._seeds,
            lambda seed: shown if seed == self._shown else self._result(seed, stage),
        )
        report = Diagnostics()
        verdict.report(report)
        stage.judged(result_record(self._path, self._name, verdict, tuple(report)))
        return f"the test `{self._name}` {'passes' if verdict.passed else 'fails'}"

    def _choose(self, stage: Stage) -> int:
        """Return the seed to show: the first with which the test fails, found in a short time."""
        began = time.monotonic()
        for number, seed in enumerate(self._seeds):
            if time.monotonic() - began > _SEARCH:
                stage.tell(f"the first {number} of {len(self._seeds)} seeds pass")
                break
            if self._result(seed, stage).failure is not None:
                stage.tell(f"seed {seed} is the first of {len(self._seeds)} that fails")
                return seed
        else:
            stage.tell(f"all {len(self._seeds)} seeds pass")
        stage.tell(f"this is seed {self._seeds[0]}")
        return self._seeds[0]

    def _result(self, seed: int, stage: Stage) -> RunResult:
        """Return the result of an unseen run."""
        if seed not in self._unseen:
            self._unseen[seed] = run_case(self._case, seed, lambda _: stage.poll())
        return self._unseen[seed]


class _Opened:
    """Recorder of a test that keeps nothing: it tells the stage who runs."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage

    def begin(
        self, subject: object, cast: Sequence[Actor], scenario: Path | None, world: World
    ) -> None:
        """Note who runs."""
        self._stage.begin(cast, world)

    def write(self, text: str, /) -> None:
        """Leave out a line."""

    def end(self, time: int) -> None:
        """Leave out the end."""


def _described(failure: Failure) -> str:
    report = Diagnostics()
    fields: dict[str, Any] = {**failure.fields}
    report.report(failure.code, failure.place, label=failure.label, **fields)
    (found,) = report
    file = Path(failure.place.source.name).name
    return f"{file}:{failure.place.line}: {found.message}: {failure.label}"


def load_test(
    arguments: Arguments, folder: Path, report: Diagnostics, judged: Callable[[Record], None]
) -> TestProgram | None:
    """Load the test that `FILE::TEST` names, or the first one of `FILE`.

    If it cannot run, that is its result, and its errors are reported. Raises RequestError for wrong
    arguments.
    """
    for key in MODEL_KEYS:
        if arguments.get(key) not in (None, ""):
            raise RequestError(f"`{key}` and `test` conflict: the test file says what runs")
    seed = optional(arguments, "seed", int)
    id_ = as_path(required(arguments, "test", str))
    files = chosen_files(read_selection([str(folder / id_)]), report)
    if len(files) != 1:
        if report.has_errors:
            return None
        raise RequestError("`test` must name one test: FILE::TEST")
    [(path, names)] = files
    models = Models()
    file = read_file(path, models, None, names)
    if names is None and file.names:
        names = frozenset(file.names[:1])
        file = read_file(path, models, None, names)
    report.include(file.problems)
    if names is not None and not file.chosen:
        report_missing(path, names, file.names, report)
    if not file.chosen:
        return None
    name, case = file.chosen[0]
    if not isinstance(case, Case):
        judged(unread_record(path, name, case, file.problems))
        return None
    return TestProgram(path, name, case, case.seeds if seed is None else (seed,))
