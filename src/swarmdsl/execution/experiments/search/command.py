"""`swarmc optimize`: search, and what is made of the result."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any, TextIO

import click
import tomli

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import MOST_RECORDED, read_file
from swarmdsl.base.records import dataclass, replace
from swarmdsl.base.source import Source
from swarmdsl.base.suggest import suggest
from swarmdsl.base.write_stream import report_unwritten, write_stream
from swarmdsl.codegen.exchange.search_space import number
from swarmdsl.driver.config.toml import parse_toml
from swarmdsl.execution.experiments.applying import apply_to_model
from swarmdsl.execution.experiments.engines import Engine, cluster, local
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.progress_bar import Feed, shown
from swarmdsl.execution.experiments.results.records import NAMES, About
from swarmdsl.execution.experiments.running import Runs
from swarmdsl.execution.experiments.search.evaluation import Aim, Together
from swarmdsl.execution.experiments.search.files import files_of
from swarmdsl.execution.experiments.search.methods import Name
from swarmdsl.execution.experiments.search.optimizing import Found, Plan, Search
from swarmdsl.execution.experiments.search.page import search_page, worst_runs
from swarmdsl.execution.experiments.search.report import as_data, as_text, settings_text
from swarmdsl.execution.experiments.search.space import SearchSpace, report_narrowed, space_of
from swarmdsl.execution.experiments.settings import apply_candidate, keys_of
from swarmdsl.execution.experiments.shipment import Conditions, Shipment, pack
from swarmdsl.execution.experiments.store import FILE, Store
from swarmdsl.execution.experiments.task import NO_SCENARIO, Candidate, canonical
from swarmdsl.execution.simulate.durations import written_duration
from swarmdsl.execution.simulate.measures import fitness_of
from swarmdsl.execution.simulate.subject import Subject
from swarmdsl.ir import Fitness, Optimization, System

HISTORY, RESULTS, REPORT = "history.jsonl", "results.json", "report.html"
Tell = Callable[[Diagnostics], None]


@dataclass(frozen=True)
class Request:
    """Arguments of the command. Without `output`, nothing is kept."""

    paths: tuple[Path, ...]
    swarm: str | None = None
    scenarios: tuple[Path, ...] = ()
    method: Name = "auto"
    evaluations: int | None = None
    seeds: int = 30
    fresh: int = 100
    seed: int | None = None
    together: Together = "mean"
    properties: tuple[str, ...] = ()
    until: int | None = None
    world: str | None = None
    jobs: int = 1
    cluster: str | None = None
    output: Path | None = None
    resume: bool = False
    apply: bool = False
    feed: Path | None = None
    is_json: bool = False
    limit: float | None = None


@dataclass(frozen=True)
class _Problem:
    """The model with its optimization, and the plan of the search."""

    subject: Subject
    system: System
    optimization: Optimization
    fitness: Fitness
    shipment: Shipment
    plan: Plan


def optimize(request: Request, tell: Tell) -> bool | None:
    """Search for the best candidate; return True without errors, None if interrupted."""
    report = Diagnostics()
    found: Found | None = None
    interrupted = False
    problem = _problem(request, report)
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
    best = search[0].best if search else None
    said = f"the best so far: {settings_text(best.candidate)}" if best is not None else "no result"
    tried = f", after {search[0].tried} candidates" if search and search[0].tried else ""
    click.echo(f"interrupted{tried}; {said}", err=True)


def _search(request: Request, problem: _Problem, searches: list[Search], stack: ExitStack) -> Found:
    plan, digest = problem.plan, problem.shipment.digest
    folder = request.output
    if folder is None:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="swarmdsl-")))
    store = stack.enter_context(Store(folder / FILE, is_new=not request.resume))
    About({digest: problem.subject.name}, goal=plan.aim.goal).write(folder)
    history = stack.enter_context(write_stream(folder / HISTORY))
    stream = stack.enter_context(write_stream(request.feed)) if request.feed is not None else None
    engine = stack.enter_context(_engine(request, problem.shipment))

    def best() -> str:
        found = searches[0].best if searches else None
        if found is None or found.mean is None:
            return ""
        return f"{found.mean:.6g} with {settings_text(found.candidate)}"

    bar = stack.enter_context(shown(plan.expected, engine.name, best))
    feed = Feed(stream, plan.expected, bar)

    def tell(line: dict[str, Any]) -> None:
        history.write(f"{canonical(line)}\n")
        history.flush()
        feed.say("evaluation", **line)

    feed.say("begin", subject=problem.subject.name, method=plan.chosen, workers=engine.name)
    runs = Runs({digest: problem.shipment}, engine, store, feed, request.limit)
    searches.append(Search(plan, runs, digest, tell))
    found = searches[0].run()
    feed.say("end", **as_data(found, plan, problem.subject.name, problem.fitness.name))
    return found


def _engine(request: Request, shipment: Shipment) -> Engine:
    if request.cluster is not None:
        return cluster(request.cluster)
    return local(request.jobs, is_apart=shipment.may_crash)


def _conclude(request: Request, problem: _Problem, found: Found, report: Diagnostics) -> None:
    """Print, write and apply a result."""
    named = problem.subject.name, problem.fitness.name
    data = f"{json.dumps(as_data(found, problem.plan, *named), indent=2)}\n"
    if request.is_json:
        click.echo(data, nl=False)
    else:
        for line in as_text(found, problem.plan, *named):
            click.echo(line)
    if request.output is not None:
        candidate = found.winner.candidate
        texts = {
            RESULTS: data,
            **dict(files_of(candidate, problem.optimization, problem.system)),
        }
        page, scenarios = _page(request, request.output, problem, found)
        texts[REPORT] = page
        for path, text in {**_below(request.output, texts), **scenarios}.items():
            with _written(path, report) as stream:
                stream.write(text)
        click.echo(f"\nwritten: {FILE}, {NAMES}, {HISTORY}, {', '.join(texts)}", err=True)
    if request.apply:
        _apply(request, problem, found, report)


def _page(
    request: Request, folder: Path, problem: _Problem, found: Found
) -> tuple[str, dict[Path, str]]:
    """Return the page of a result, and the scenarios that play runs on it."""
    plan, words = problem.plan, ["swarmc", "simulate", *map(str, request.paths)]
    given = (
        ("--swarm", request.swarm),
        ("--world", request.world),
        ("--until", written_duration(request.until) if request.until is not None else None),
    )
    words += [word for name, value in given if value is not None for word in (name, value)]
    texts = problem.shipment.scenarios
    worst, scenarios = worst_runs(found, plan, texts, words, folder / "runs")
    lines = read_file(folder / HISTORY, MOST_RECORDED).decode()
    history = [json.loads(line) for line in lines.splitlines()]
    names = problem.subject.name, problem.fitness.name
    return search_page(found, plan, names, history, worst), scenarios


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


def _apply(request: Request, problem: _Problem, found: Found, report: Diagnostics) -> None:
    """Write the winner into the model, unless it is not better than today's."""
    if found.comparison is not None and found.comparison.answer == "no":
        report.report("not-applied", help="the model is as it was", name=problem.subject.name)
        return
    try:
        _require_free(found.winner.candidate, problem)
        changed = problem.plan.space.changed(found.winner.candidate)
        layouts = apply_to_model(request.paths, problem.subject.name, changed, report)
    except StoppedError as stopped:
        stopped.report(report)
        return
    for layout in layouts:
        click.echo(layout.diff(), nl=False, err=True)
    if not layouts and not report.has_errors:
        click.echo("the model has these values already", err=True)


def _require_free(winner: Candidate, problem: _Problem) -> None:
    """Raise StoppedError if a scenario has its own value of a setting, which the model has not.

    A value for one robot is no matter: runs of the search had it too.
    """
    for path, text in problem.shipment.scenarios.items():
        values = tomli.loads(text)
        for name, value in winner.settings:
            for keys in _places_of(name, problem.subject):
                given: Any = values
                for key in keys:
                    given = given.get(key) if isinstance(given, dict) else None
                if given is None or given == value:
                    continue
                key = ".".join(keys)
                help_ = f"remove `{key}` there, or write {value} there"
                reason = f"`{path}` says `{key}` itself, for all runs with it"
                raise StoppedError("cannot-apply", help_, name=problem.subject.name, reason=reason)


def _places_of(setting: str, subject: Subject) -> list[tuple[str, ...]]:
    """Return the keys of a setting in a scenario: under the role, and under its type."""
    keys = keys_of(setting)
    assert subject.swarm is not None
    member = next((each.member for each in subject.swarm.roles if each.name == keys[1]), None)
    if keys[0] != "params" or member is None:
        return [keys]
    return [keys, (keys[0], member.rpartition(".")[2], *keys[2:])]


def _check_scenarios(
    shipment: Shipment, subject: Subject, space: SearchSpace, report: Diagnostics
) -> None:
    """Report what is wrong in scenarios with the candidate that has the most members."""
    candidate = space.candidate([1.0] * len(space.dimensions))
    for name, text in shipment.scenarios.items():
        document = parse_toml(Source(name, text, Path(name)), report)
        if document is not None:
            apply_candidate(candidate, document, subject, report)


def _problem(request: Request, report: Diagnostics) -> _Problem | None:
    """Load the model, and find out what is to be optimized."""
    conditions = Conditions(request.until, request.world, ())
    packed = pack(request.paths, request.swarm, request.scenarios, report, conditions)
    if packed is None:
        return None
    shipment, subject = packed
    system = subject.system
    assert system is not None
    optimization = next((o for o in system.optimizations if o.swarm == subject.name), None)
    if optimization is None:
        help_ = f"declare its ranges: `optimize {subject.name} {{ count of role in 1 .. 5 }}`"
        report.report("nothing-to-optimize", name=subject.name, reason="no `optimize`", help=help_)
        return None
    fitness = fitness_of(subject)
    if fitness is None:
        help_ = "give its inputs measures, as in `in done : uint32 = total(robot in Done)`"
        reason = "no fitness that a run measures"
        report.report("nothing-to-optimize", name=subject.name, reason=reason, help=help_)
        return None
    space = space_of(optimization, system)
    if not space.dimensions:
        help_ = "add `role.param in 1.0 .. 5.0` or `count of role in 1 .. 5`"
        reason = "no range in its `optimize`"
        report.report("nothing-to-optimize", name=subject.name, reason=reason, help=help_)
        return None
    report_narrowed(optimization, system, space, report)
    if not report.has_errors:
        _check_scenarios(shipment, subject, space, report)
    known = [each.name for each in system.properties if each.subject == subject.name]
    chances = [each.name for each in system.properties if each.chance is not None]
    for name in request.properties:
        if name not in known or name in chances:
            help_ = suggest(name, known, "properties")
            kind = f"property of `{subject.name}`"
            if name in chances:
                kind, help_ = "property of one run", f"`{name}` has a chance: it is about many"
            report.report("unresolved-name", kind=kind, name=name, help=help_)
    if report.has_errors:
        return None
    kept = dict.fromkeys(each.property for each in optimization.constraints)
    properties = tuple({**kept, **dict.fromkeys(request.properties)})
    shipment = replace(shipment, conditions=replace(conditions, properties=properties))
    given = {name: int(number(value)) for name, value in optimization.settings}
    seed = request.seed if request.seed is not None else given.get("seed", 0)
    plan = Plan(
        space,
        Aim(fitness.goal, request.together, properties),
        tuple(map(str, request.scenarios)) or (NO_SCENARIO,),
        request.method,
        request.evaluations or given.get("evaluations", 200),
        request.seeds,
        request.fresh,
        seed,
    )
    return _Problem(subject, system, optimization, fitness, shipment, plan)
