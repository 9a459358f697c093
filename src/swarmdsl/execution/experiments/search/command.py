"""`swarmc optimize`: search, and what is made of the result."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any, TextIO

import click

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import MOST_RECORDED, read_file
from swarmdsl.base.write_stream import report_unwritten, write_stream
from swarmdsl.execution.experiments.engines import engine_of
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.progress_bar import Feed, shown
from swarmdsl.execution.experiments.results.records import NAMES, About
from swarmdsl.execution.experiments.running import Runs
from swarmdsl.execution.experiments.search.apply import apply_candidate_of
from swarmdsl.execution.experiments.search.files import remove_other_points
from swarmdsl.execution.experiments.search.front_search import FrontSearch
from swarmdsl.execution.experiments.search.optimizing import Search
from swarmdsl.execution.experiments.search.outcome import FrontOutcome, Outcome, WinnerOutcome
from swarmdsl.execution.experiments.search.page import worst_runs
from swarmdsl.execution.experiments.search.problem import Problem, Request, problem_of
from swarmdsl.execution.experiments.store import FILE, Store
from swarmdsl.execution.experiments.task import canonical
from swarmdsl.execution.simulate.scenario.durations import written_duration

HISTORY, RESULTS, REPORT = "history.jsonl", "results.json", "report.html"
Tell = Callable[[Diagnostics], None]


def optimize(request: Request, tell: Tell) -> bool | None:
    """Search for the best candidate; return True without errors, None if interrupted."""
    report = Diagnostics()
    found: Outcome | None = None
    interrupted = False
    problem = problem_of(request, report)
    tell(report)
    if problem is None:
        return False
    report = Diagnostics()
    search: list[Search] = []
    try:
        with ExitStack() as stack:
            found = _search(request, problem, search, stack)
    except KeyboardInterrupt:
        interrupted = True
        _say_so_far(search)
    except StoppedError as stopped:
        stopped.report(report)
    except OSError as error:
        report_unwritten(Path(error.filename or "."), error, report)
    if found is not None:
        _conclude(request, problem, found, report)
    tell(report)
    return None if interrupted else not report.has_errors


def _say_so_far(search: list[Search]) -> None:
    said = f"the best so far: {search[0].so_far}" if search and search[0].so_far else "no result"
    tried = f", after {search[0].tried} candidates" if search and search[0].tried else ""
    click.echo(f"interrupted{tried}; {said}", err=True)


def _search(
    request: Request, problem: Problem, searches: list[Search], stack: ExitStack
) -> Outcome:
    plan, digest = problem.plan, problem.shipment.digest
    folder = request.output
    if folder is None:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="swarmdsl-")))
    store = stack.enter_context(Store(folder / FILE, is_new=not request.resume))
    About({digest: problem.subject.name}, plan.aim.measure, plan.aim.goal).write(folder)
    history = stack.enter_context(write_stream(folder / HISTORY))
    stream = stack.enter_context(write_stream(request.feed)) if request.feed is not None else None
    is_apart = problem.shipment.may_crash
    engine = stack.enter_context(engine_of(request.cluster, request.jobs, is_apart=is_apart))

    def best() -> str:
        return searches[0].so_far if searches else ""

    bar = stack.enter_context(shown(plan.expected, engine.name, best))
    feed = Feed(stream, plan.expected, bar)

    def tell(line: dict[str, Any]) -> None:
        history.write(f"{canonical(line)}\n")
        history.flush()
        feed.say("evaluation", **line)

    feed.say("begin", subject=problem.subject.name, method=plan.chosen, workers=engine.name)
    runs = Runs({digest: problem.shipment}, engine, store, feed, request.limit)
    found: Outcome
    if plan.aim.others:
        front = FrontSearch(plan, runs, digest, tell)
        searches.append(front)
        found = FrontOutcome(problem, front.run_front())
    else:
        searches.append(Search(plan, runs, digest, tell))
        found = WinnerOutcome(problem, searches[0].run())
    feed.say("end", **found.data())
    return found


def _conclude(request: Request, problem: Problem, found: Outcome, report: Diagnostics) -> None:
    """Print, write and apply a result."""
    data = f"{json.dumps(found.data(), indent=2)}\n"
    if request.is_json:
        click.echo(data, nl=False)
    else:
        for line in found.lines():
            click.echo(line)
    if request.output is not None:
        _write(request, request.output, problem, found, data, report)
    if request.apply:
        candidate = found.to_apply(request.point, report)
        if candidate is not None:
            apply_candidate_of(problem, candidate, report)


def _write(
    request: Request,
    folder: Path,
    problem: Problem,
    found: Outcome,
    data: str,
    report: Diagnostics,
) -> None:
    """Write the files of a result."""
    words = ["swarmc", "simulate", *map(str, request.paths)]
    given = (
        ("--swarm", request.swarm),
        ("--world", request.world),
        ("--until", written_duration(request.until) if request.until is not None else None),
    )
    words += [word for name, value in given if value is not None for word in (name, value)]
    texts = problem.shipment.scenarios
    worst, scenarios = worst_runs(found.worst(), problem.plan, texts, words, folder / "runs")
    lines = read_file(folder / HISTORY, MOST_RECORDED).decode()
    history = [json.loads(line) for line in lines.splitlines()]
    files = {RESULTS: data, **found.files(), REPORT: found.page(history, worst)}
    try:
        remove_other_points(folder, files)
    except OSError as error:
        report_unwritten(Path(error.filename), error, report)
    for path, text in {**_below(folder, files), **scenarios}.items():
        with _written(path, report) as stream:
            stream.write(text)
    if not request.is_json:
        click.echo("")
        for each in worst:
            value = f" ({each.value:.6g})" if each.value is not None else ""
            click.echo(f"{each.why}: seed {each.seed}{value}: {each.command}")
    click.echo(f"\nwritten: {FILE}, {NAMES}, {HISTORY}, {', '.join(files)}", err=True)


def _below(folder: Path, texts: Mapping[str, str]) -> dict[Path, str]:
    return {folder / name: text for name, text in texts.items()}


@contextmanager
def _written(path: Path, report: Diagnostics) -> Iterator[TextIO]:
    try:
        path.parent.mkdir(exist_ok=True)
        with write_stream(path) as stream:
            yield stream
    except OSError as error:
        report_unwritten(path, error, report)
