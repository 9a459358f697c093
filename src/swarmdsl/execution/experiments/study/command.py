"""`swarmc experiment`: run a study, and tell what follows from it."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TextIO

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.write_stream import report_unwritten, write_stream
from swarmdsl.execution.experiments.engines import Engine, engine_of
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.measured import FITNESS
from swarmdsl.execution.experiments.progress_bar import Feed, shown
from swarmdsl.execution.experiments.report.page import html
from swarmdsl.execution.experiments.results.records import About
from swarmdsl.execution.experiments.running import Progress, Runs
from swarmdsl.execution.experiments.store import FILE, Store
from swarmdsl.execution.experiments.study.analysis import Analysis, Result, analyse, result_of
from swarmdsl.execution.experiments.study.data import as_data
from swarmdsl.execution.experiments.study.models import OpenModel, Setting, goal_of, open_study
from swarmdsl.execution.experiments.study.page import page
from swarmdsl.execution.experiments.study.plan import Study
from swarmdsl.execution.experiments.study.study_file import read_study
from swarmdsl.execution.experiments.study.tables import answers, conditions, grids
from swarmdsl.execution.experiments.study.worst import Played, worst_of
from swarmdsl.execution.experiments.task import SCENARIO, Row, Task
from swarmdsl.execution.simulate.evaluation.summary import format_table
from swarmdsl.execution.simulate.run.prepare import Request as Simulation

Tell = Callable[[Diagnostics], None]
Play = Callable[[Sequence[tuple[Simulation, Path]], Diagnostics], Iterator[Path]]
"""Writes the pages of runs, and yields those that it has written."""
_WORLD = f"{SCENARIO}world.kind"
"""Factor that may have worlds with a library in C."""
_RESULTS, _REPORT, _RUNS = "results.json", "report.html", "runs"


@dataclass(frozen=True)
class Request:
    """Arguments of the command; `address` is that of a cluster."""

    path: Path
    output: Path | None = None
    jobs: int = 1
    address: str | None = None
    resume: bool = False
    as_json: bool = False
    limit: float | None = None
    feed: Path | None = None

    @property
    def folder(self) -> Path:
        """Folder of the results."""
        return self.output if self.output is not None else Path(f"{self.path.stem}-results")


def run_study(
    request: Request,
    open_model: OpenModel,
    out: TextIO,
    tell: Tell,
    play: Play | None = None,
) -> bool | None:
    """Run a study; return True without errors, None if interrupted.

    `play` writes the pages of the worst and the best run.
    """
    report = Diagnostics()
    study = read_study(request.path, report)
    setting = open_study(study, open_model, report) if study is not None else None
    tell(report)
    if study is None or setting is None:
        return False
    report = Diagnostics()
    try:
        engine = _engine(request, study, setting)
        with write_stream(request.feed) if request.feed is not None else nullcontext() as stream:
            done = _run(request, study, setting, engine, stream)
            found = _analysis(study, setting, done.rows)
            data = as_data(found, setting.first.subject.name)
            Feed(stream, 0, Progress()).say("end", **data)
    except StoppedError as stopped:
        stopped.report(report)
        tell(report)
        return False
    except OSError as error:
        report_unwritten(Path(error.filename or request.feed or "."), error, report)
        tell(report)
        return False
    _report_failures(found, report)
    played = worst_of(found, setting, request.folder / _RUNS)
    written = list(_write(request.folder, found, data, played, report))
    if play is not None and not done.interrupted:
        written += play(played.ends, report)
    tell(report)
    subject = setting.first.subject.name
    if request.as_json:
        out.write(f"{json.dumps(data, indent=2)}\n")
    else:
        for line in _text(found, subject, played, done):
            out.write(f"{line}\n")
        out.write(f"written: {', '.join(map(str, written))}\n")
    return None if done.interrupted else not report.has_errors


def _engine(request: Request, study: Study, setting: Setting) -> Engine:
    is_apart = any(each.shipment.may_crash for each in setting.models) or any(
        each.name == _WORLD for each in study.factors
    )
    return engine_of(request.address, request.jobs, is_apart=is_apart)


@dataclass(frozen=True)
class _Done:
    """Rows by task, the number of runs that were not known, and if the user ended them."""

    rows: dict[Task, Sequence[Row]]
    ran: int
    interrupted: bool


def _run(
    request: Request, study: Study, setting: Setting, engine: Engine, stream: TextIO | None
) -> _Done:
    """Run all points of the design, each once. Raises StoppedError."""
    tasks = list(dict.fromkeys(map(setting.task, study.design_points())))
    if study.design not in ("morris", "indices"):
        tasks = list(dict.fromkeys([*tasks, setting.today()]))
    shipments = {each.shipment.digest: each.shipment for each in setting.models}
    with ExitStack() as stack:
        store = stack.enter_context(Store(request.folder / FILE, is_new=not request.resume))
        models = {each.shipment.digest: each.title for each in setting.models}
        About(models, study.measure or FITNESS, goal_of(setting)).write(request.folder)
        stack.enter_context(engine)
        expected = len(tasks) * study.repetitions
        bar = stack.enter_context(shown(expected, engine.name, str))
        feed = Feed(stream, expected, bar)
        subject = setting.first.subject.name
        feed.say("begin", subject=subject, design=study.design, workers=engine.name)
        runs = Runs(shipments, engine, store, feed, request.limit)
        try:
            return _Done(dict(zip(tasks, runs.run(tasks), strict=True)), runs.ran, False)
        except KeyboardInterrupt:
            engine.stop(is_hurried=True)
            return _Done(dict(zip(tasks, runs.known(tasks), strict=True)), runs.ran, True)


def _analysis(study: Study, setting: Setting, rows: dict[Task, Sequence[Row]]) -> Analysis:
    measure = study.measure or FITNESS

    def result(point: tuple[bool | int | float | str, ...], task: Task) -> Result:
        return result_of(point, task, rows[task], measure, study.confidence)

    points = list(dict.fromkeys(study.design_points()))
    results = [result(point, setting.task(point)) for point in points]
    today = setting.today()
    as_it_is = result((), today) if today in rows else None
    return analyse(study, goal_of(setting), results, as_it_is)


def _report_failures(found: Analysis, report: Diagnostics) -> None:
    """Report runs without a result; those of the model as it is are only a comparison."""
    rows = [row for each in found.results for row in each.rows]
    failed = [row for row in rows if row.failure is not None]
    if failed:
        report.report(
            "failed-runs",
            count=len(failed),
            runs=len(rows),
            reason=failed[0].failure,
            help="the table of points says which settings they have; `swarmc results` lists them",
        )


def _write(
    folder: Path, found: Analysis, data: dict[str, Any], played: Played, report: Diagnostics
) -> Iterator[Path]:
    """Write the files of results; yield their names."""
    texts = {
        folder / _RESULTS: f"{json.dumps(data, indent=2)}\n",
        folder / _REPORT: html(page(found, data["subject"], played.runs)),
        **played.scenarios,
    }
    for path, text in texts.items():
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            with write_stream(path) as stream:
                stream.write(text)
        except OSError as error:
            report_unwritten(path, error, report)
            continue
        if path.parent == folder:
            yield path


def _text(found: Analysis, subject: str, played: Played, done: _Done) -> Iterator[str]:
    for name, value in conditions(found, subject):
        yield f"{name:<10}  {value}"
    if done.interrupted:
        yield "interrupted: what follows is about the runs that are done; `--resume` goes on"
    yield ""
    for grid in grids(found):
        yield f"{grid.title}:"
        yield from format_table(grid.head, grid.rows, grid.left)
    yield from answers(found)
    if played.runs:
        yield ""
    for each in played.runs:
        value = "" if each.value is None else f" ({each.value:.6g})"
        yield f"{each.why}: seed {each.seed}{value}: {each.command}"
    yield ""
