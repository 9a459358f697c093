"""`swarmc simulate --runs`: many runs with different seeds, and estimates from them."""

from __future__ import annotations

import gc
import json
import shlex
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import get_context
from pathlib import Path

import click

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.write_stream import report_unwritten, write_stream
from swarmdsl.execution.simulate.many_runs.chances import Level
from swarmdsl.execution.simulate.many_runs.estimates import Estimates
from swarmdsl.execution.simulate.many_runs.histogram import histograms
from swarmdsl.execution.simulate.many_runs.one_run import Outcome, Runner, begin, run_seeds
from swarmdsl.execution.simulate.run.prepare import Request, prepare
from swarmdsl.execution.simulate.scenario.durations import written_duration

Tell = Callable[[Diagnostics], None]


@dataclass(frozen=True)
class Many:
    """Number of runs, of processes, and what to make of the results."""

    runs: int
    jobs: int
    level: Level
    early: bool = False
    histogram: Path | None = None


def simulate_many(many: Many, request: Request, tell: Tell) -> bool | None:
    """Run a subject many times; return True without errors, None if interrupted."""
    report = Diagnostics()
    prepared = prepare(request, report)
    if prepared is not None:
        prepared.stage(report)
    tell(report)
    if prepared is None or report.has_errors:
        return False
    gc.enable()
    runner = Runner(request, prepared)
    estimates = Estimates(runner.properties, runner.fitness, many.level)
    report = Diagnostics()
    interrupted = _gather(request, many, runner, estimates, report)
    estimates.report(report, lambda seed: _command(request, seed))
    scenario = str(request.scenario) if request.scenario is not None else None
    conditions = {
        "subject": prepared.subject.name,
        "scenario": scenario,
        "runs": len(estimates.outcomes),
        "wanted": many.runs,
        "first_seed": runner.first_seed,
    }
    written = _write(
        request.results,
        lambda: f"{json.dumps({**conditions, **estimates.as_data()}, indent=2)}\n",
        report,
    )
    if any(each.by_seed for each in estimates.values):
        written += _write(many.histogram, lambda: histograms(estimates), report)
    elif many.histogram is not None:
        report.report("no-histogram", path=many.histogram)
    tell(report)
    ran = estimates.head(
        prepared.subject.name, scenario, many.runs, interrupted=interrupted, early=many.early
    )
    for line in (ran, "", *estimates.text(lambda seed: _command(request, seed))):
        click.echo(line)
    if written:
        click.echo(f"\nwritten: {', '.join(written)}", err=True)
    return None if interrupted else not report.has_errors


def _gather(
    request: Request, many: Many, runner: Runner, estimates: Estimates, report: Diagnostics
) -> bool:
    """Run until all is done or decided; return True if interrupted."""
    seeds = range(runner.first_seed, runner.first_seed + many.runs)
    try:
        with _progress(many.runs) as advance:
            for outcome in _outcomes(request, many.jobs, runner, seeds):
                estimates.add(outcome)
                advance()
                if many.early and estimates.all_decided:
                    break
    except KeyboardInterrupt:
        return True
    except BrokenProcessPool:
        after = len(estimates.outcomes)
        help_ = "the system may lack memory: try fewer `--jobs`"
        report.report("lost-worker", runs=after, help=help_)
    return False


def _outcomes(request: Request, jobs: int, runner: Runner, seeds: range) -> Iterator[Outcome]:
    """Yield the outcomes in the order of the seeds, whoever is done first."""
    if jobs == 1 and not runner.is_together:
        yield from map(runner.run, seeds)
        return
    size = runner.batch
    batches = [seeds[first : first + size] for first in range(0, len(seeds), size)]
    if jobs == 1:
        for batch in batches:
            yield from runner.run_all(batch)
        return
    # Processes that are not copies of this one are the same on each platform.
    pool = ProcessPoolExecutor(jobs, get_context("spawn"), begin, (request,))
    try:
        for outcomes in pool.map(run_seeds, batches):
            yield from outcomes
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


@contextmanager
def _progress(total: int) -> Iterator[Callable[[], object]]:
    """Show how far the runs are, on a terminal."""
    if not sys.stderr.isatty():
        yield lambda: None
        return
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("runs", total=total)
        yield lambda: progress.advance(task)


def _write(path: Path | None, text: Callable[[], str], report: Diagnostics) -> list[str]:
    """Write a file, if requested; return its name."""
    if path is None:
        return []
    try:
        with write_stream(path) as stream:
            stream.write(text())
    except OSError as error:
        report_unwritten(path, error, report)
        return []
    return [str(path)]


def _command(request: Request, seed: int) -> str:
    """Return the command that repeats a run."""
    words = ["swarmc", "simulate", *map(str, request.paths)]
    given = (
        ("--swarm", request.swarm),
        ("--machine", request.machine),
        ("--scenario", request.scenario),
        ("--events", request.events),
        ("--until", written_duration(request.until) if request.until is not None else None),
        *(("--property", name) for name in request.only),
        ("--seed", seed),
    )
    for option, value in given:
        if value is not None:
            words += [option, str(value)]
    return shlex.join(words)
