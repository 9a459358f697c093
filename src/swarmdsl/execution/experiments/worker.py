"""Work of a process that runs tasks: from texts and seeds to rows, in JSON types only.

`work` is imported by name, in processes of this computer and of others. It compiles a model once
and keeps it.
"""

from __future__ import annotations

import atexit
import gc
import os
import time
from collections import OrderedDict
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from multiprocessing.util import Finalize
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Lock
from typing import Any, TypeVar

from swarmdsl import __version__
from swarmdsl.base.diagnostics.collector import Diagnostics, Severity
from swarmdsl.base.errors import describe_exception
from swarmdsl.base.source import Source
from swarmdsl.driver import pipeline
from swarmdsl.driver.config import ModelSource, Settings
from swarmdsl.driver.config.toml import Document, parse_toml
from swarmdsl.execution.experiments.settings import EMPTY, apply_candidate
from swarmdsl.execution.experiments.shipment import Shipment, shipment_of
from swarmdsl.execution.experiments.task import NO_SCENARIO, Candidate, canonical
from swarmdsl.execution.experiments.time_limit import OverdueError, deadly, limited
from swarmdsl.execution.simulate.evaluation.measures import inputs_of
from swarmdsl.execution.simulate.inputs.choose_space import choose_space
from swarmdsl.execution.simulate.machines.subject import Subject, choose
from swarmdsl.execution.simulate.many_runs.one_run import Outcome, Runner
from swarmdsl.execution.simulate.run.prepare import Prepared, Request
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.syntax.types import DURATION

LIMIT = 60.0
"""Seconds that a run may take."""

_MOST_MODELS, _MOST_RUNNERS = 8, 64
_T = TypeVar("_T")


def work(shipment: Mapping[str, Any], task: Mapping[str, Any]) -> dict[str, Any]:
    """Run a task; return its rows as JSON types, or why this process refuses it.

    `task` has a `scenario`, a `candidate`, `seeds`, the process that asks (`main`), and perhaps the
    `limit` of a run in seconds.
    """
    if shipment["version"] != __version__:
        return {"refused": f"it has swarmdsl {__version__}, not {shipment['version']}"}
    # A worker of a cluster may have several threads.
    with _lock:
        begin = time.perf_counter()
        # A process of the user does not end for a run.
        with deadly(os.getpid() != task["main"]):
            rows, batch = _rows(shipment, task)
        seconds = time.perf_counter() - begin
    return {"rows": rows, "seconds": seconds, "batch": batch, "worker": os.getpid()}


_lock = Lock()


class _Kept(OrderedDict[str, _T]):
    """Values that were used last, up to a number."""

    def __init__(self, most: int) -> None:
        super().__init__()
        self._most = most

    def get_or_make(self, key: str, make: Callable[[], _T]) -> _T:
        """Return what is kept, or make it."""
        if key not in self:
            self[key] = make()
            if len(self) > self._most:
                self.popitem(last=False)
        self.move_to_end(key)
        return self[key]


class _Unfit(Exception):  # noqa: N818 - no error of this program
    """A candidate or a model that cannot run, with the reason."""


class _Model:
    """A compiled model with its scenarios."""

    def __init__(self, shipment: Shipment) -> None:
        self.conditions = shipment.conditions
        self.subject = _compiled(shipment)
        self._shipment = shipment
        self._scenarios: dict[str, Document] = {NO_SCENARIO: EMPTY}

    def scenario(self, name: str, texts: Mapping[str, str]) -> Document:
        """Return the document of a scenario."""
        if name not in self._scenarios:
            report = Diagnostics()
            source = Source(name, texts[name], Path(name))
            found = parse_toml(source, report)
            _require(report)
            self._scenarios[name] = found or EMPTY
        return self._scenarios[name]


_models: _Kept[_Model] = _Kept(_MOST_MODELS)
_runners: _Kept[Runner] = _Kept(_MOST_RUNNERS)


def _rows(shipment: Mapping[str, Any], task: Mapping[str, Any]) -> tuple[list[Any], int]:
    """Return the rows of a task, and how many runs go best together."""
    gc.enable()
    seeds, limit = task["seeds"], task.get("limit", LIMIT)
    try:
        with limited(LIMIT + limit):
            runner = _runner(shipment, task)
        outcomes = _outcomes(runner, seeds, limit)
    except _Unfit as unfit:
        return [failed(seed, str(unfit)) for seed in seeds], 1
    except OverdueError:
        return [failed(seed, "it takes too long to begin") for seed in seeds], 1
    except Exception as error:
        reason = describe_exception("the beginning of a run", error)
        return [failed(seed, reason) for seed in seeds], 1
    batch = runner.batch if runner.is_together else 1
    return [_row(runner, each) for each in outcomes], batch


def _runner(shipment: Mapping[str, Any], task: Mapping[str, Any]) -> Runner:
    digest, scenario, settings = shipment["digest"], task["scenario"], task["candidate"]
    model = _models.get_or_make(digest, lambda: _Model(shipment_of(shipment)))
    document = model.scenario(scenario, shipment["scenarios"])
    candidate = Candidate.of(settings)
    key = canonical([digest, document.source.text, settings])
    return _runners.get_or_make(key, lambda: _prepared(model, document, candidate))


def _prepared(model: _Model, document: Document, candidate: Candidate) -> Runner:
    report = Diagnostics()
    conditions, subject = model.conditions, model.subject
    scenario = apply_candidate(candidate, document, subject, report)
    _require(report)
    assert scenario is not None
    spaces = choose_space(conditions.world or scenario.world, subject, scenario, report)
    _require(report)
    prepared = Prepared(subject, scenario, None, spaces)
    prepared.stage(report)
    _require(report)
    watched = conditions.properties
    request = Request(
        (), until=conditions.until, properties=watched is None or watched != (), only=watched or ()
    )
    return Runner(request, prepared)


def _outcomes(runner: Runner, seeds: Sequence[int], limit: float) -> list[Outcome]:
    """Return the outcomes of runs; one that takes too long fails."""
    if len(seeds) > 1:
        # Each run has its own chance if all of them together have none.
        with suppress(OverdueError, Exception), limited(limit * len(seeds)):
            return runner.run_all(seeds)
    return [_outcome(runner, seed, limit) for seed in seeds]


def _outcome(runner: Runner, seed: int, limit: float) -> Outcome:
    try:
        with limited(limit):
            return runner.run(seed)
    except OverdueError:
        return Outcome(seed, failure=f"it does not end within {limit:g} s")
    # A failure of one candidate must not end the others.
    except Exception as error:
        return Outcome(seed, failure=describe_exception("a run", error))


def _row(runner: Runner, outcome: Outcome) -> dict[str, Any]:
    """Return the data of `Row.as_data`."""
    if outcome.failure:
        return failed(outcome.seed, outcome.failure)
    inputs = inputs_of(runner.fitness)
    measures: dict[str, float | None] = {}
    for each, (value, _) in zip(inputs, outcome.measures, strict=True):
        is_time = each.type == DURATION and value is not None
        measures[each.name] = value / SECOND if is_time and value is not None else value
    names = (each.name for each in runner.properties)
    found: dict[str, Any] = {
        "seed": outcome.seed,
        "measures": measures,
        "fitness": outcome.fitness,
        "verdicts": dict(zip(names, outcome.verdicts, strict=True)),
    }
    reached = zip(inputs, outcome.measures, strict=True)
    if unreached := [each.name for each, (_, is_reached) in reached if not is_reached]:
        found["unreached"] = unreached
    if runner.fitness is not None and outcome.fitness is None:
        found["failure"] = f"it has no fitness: {outcome.reason}"
    return found


def failed(seed: int, failure: str) -> dict[str, Any]:
    """Return the data of a run without a result."""
    return {"seed": seed, "measures": {}, "fitness": None, "verdicts": {}, "failure": failure}


def _compiled(shipment: Shipment) -> Subject:
    """Compile the texts in a folder of their own."""
    folder = TemporaryDirectory(prefix="swarmdsl-")
    try:
        subject = _compiled_in(Path(folder.name), shipment)
    except BaseException:
        folder.cleanup()
        raise
    if any(path is not None for _, path in shipment.models.values()):
        # Each candidate loads the models of the project from there. Processes of a pool end
        # without `atexit`.
        atexit.register(folder.cleanup)
        Finalize(None, folder.cleanup, exitpriority=0)
    else:
        folder.cleanup()
    return subject


def _compiled_in(folder: Path, shipment: Shipment) -> Subject:
    for name, text in shipment.texts.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8", newline="\n")
    models = {
        name: ModelSource(name, attribute, folder / path if path is not None else None)
        for name, (attribute, path) in shipment.models.items()
    }
    libraries = tuple(folder / path for path in shipment.libraries)
    settings = Settings(name=shipment.name, libraries=libraries, models=models)
    checked = pipeline.check([folder / path for path in shipment.paths], settings)
    _require(checked.report)
    report = Diagnostics()
    subject = choose(checked.system, [], None, shipment.swarm, report)
    _require(report)
    assert subject is not None
    subject.models = models
    return subject


def _require(report: Diagnostics) -> None:
    """Raise _Unfit if there is an error."""
    for each in report:
        if each.severity is Severity.ERROR:
            raise _Unfit(each.message)
