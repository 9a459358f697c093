"""Models and scenarios of a study, packed for workers, and its points as tasks."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics, Label, Severity
from swarmdsl.base.read_files import MOST_DATA, exists
from swarmdsl.base.records import replace
from swarmdsl.base.source import COMMAND_LINE, Source, Span
from swarmdsl.driver.config.toml import Document, parse_toml
from swarmdsl.execution.experiments.comparing import Goal
from swarmdsl.execution.experiments.designs.factors import Point, Value
from swarmdsl.execution.experiments.measured import FITNESS, measures
from swarmdsl.execution.experiments.settings import EMPTY, apply_candidate
from swarmdsl.execution.experiments.shipment import Conditions, Shipment, pack
from swarmdsl.execution.experiments.study.plan import Study, Varied
from swarmdsl.execution.experiments.task import NO_SCENARIO, SCENARIO, Candidate, Task
from swarmdsl.execution.simulate.evaluation.measures import fitness_of
from swarmdsl.execution.simulate.inputs.choose_space import choose_space
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.run.prepare import Prepared
from swarmdsl.project.read_source import read_source

OpenModel = Callable[[str, Path, Diagnostics], Path | None]
"""Return the path of a model or of a revision of one, from a text beside a folder."""


@dataclass(frozen=True)
class Model:
    """A packed model; `name` is its level, empty if the models are not varied."""

    name: Value
    shipment: Shipment
    subject: Subject
    places: tuple[tuple[str, str], ...]
    """Revisions of git, empty for a file on disk, with the paths in them."""

    @property
    def title(self) -> str:
        """Name for people."""
        return str(self.name) or ", ".join(
            f"{rev}:{path}" if rev else path for rev, path in self.places
        )


class Setting:
    """Models of a study by level, and what a point of its design means for them."""

    def __init__(self, study: Study, models: tuple[Model, ...]) -> None:
        self.study = study
        self.models = models
        self._by_name = {each.name: each for each in models}

    @property
    def first(self) -> Model:
        """The first model."""
        return self.models[0]

    def model(self, point: Point) -> Model:
        """Return the model of a point."""
        return self._by_name[self._level("model", point, "")]

    def scenario(self, point: Point) -> str:
        """Return the name of the scenario of a point in the shipment."""
        given = str(self.study.scenario) if self.study.scenario is not None else NO_SCENARIO
        level = self._level("scenario", point, None)
        return given if level is None else str(self.study.folder / str(level))

    def candidate(self, point: Point, without: Collection[int] = ()) -> Candidate:
        """Return the settings of a point, except those of some factors by number."""
        found: dict[str, Any] = {}
        for number, (each, value) in enumerate(zip(self.study.factors, point, strict=True)):
            if number in without:
                continue
            if each.kind == "setting":
                found[each.name] = each.setting(value)
            elif each.kind == "faults":
                found[f"{SCENARIO}faults"] = each.setting(value)
        return Candidate.of(found)

    def task(self, point: Point) -> Task:
        """Return the runs of a point."""
        study = self.study
        seeds = tuple(range(study.seed, study.seed + study.repetitions))
        digest = self.model(point).shipment.digest
        return Task(digest, self.scenario(point), self.candidate(point), seeds)

    def today(self) -> Task:
        """Return the runs of the first model as it is, in the first scenario."""
        study = self.study
        seeds = tuple(range(study.seed, study.seed + study.repetitions))
        levels = next(
            (each.factor.levels for each in study.factors if each.kind == "scenario"), None
        )
        scenario = str(study.folder / str(levels[0])) if levels else NO_SCENARIO
        if study.scenario is not None:
            scenario = str(study.scenario)
        return Task(self.first.shipment.digest, scenario, Candidate(), seeds)

    def _level(self, kind: str, point: Point, default: Any) -> Any:
        for each, value in zip(self.study.factors, point, strict=True):
            if each.kind == kind:
                return value
        return default


def open_study(study: Study, open_model: OpenModel, report: Diagnostics) -> Setting | None:
    """Load the models and scenarios of a study, and check all levels with them.

    None if something is wrong.
    """
    scenarios = [
        path
        for path, place in _scenarios(study)
        if read_source(path, place, report, "a scenario", MOST_DATA) is not None
    ]
    conditions = Conditions(study.until, study.world)
    models = []
    for name, texts, place in _models(study):
        found = Diagnostics()
        paths = [path for text in texts if (path := open_model(text, study.folder, found))]
        packed = None
        if not found.has_errors:
            packed = pack(paths, study.swarm, scenarios, found, conditions, 'swarm = "{}"')
        swarm = study.places.get("swarm")
        report.include(
            _placed(each, swarm if each.name == "unresolved-name" else place) for each in found
        )
        if packed is not None:
            models.append(Model(name, *packed, _places(texts, study.folder)))
    if report.has_errors:
        return None
    setting = Setting(study, tuple(models))
    _check_measure(setting, report)
    _check_levels(setting, report)
    return None if report.has_errors else setting


def _places(texts: tuple[str, ...], folder: Path) -> tuple[tuple[str, str], ...]:
    """Return the revision and the path of each file of a model."""
    found = []
    for text in texts:
        revision, colon, path = text.partition(":")
        # One letter before a colon is a drive of Windows.
        on_disk = exists(folder / text) or not colon or len(revision) < 2
        found.append(("", str(folder / text)) if on_disk else (revision, str(folder / path)))
    return tuple(found)


def _models(study: Study) -> Iterator[tuple[Value, tuple[str, ...], Span | None]]:
    for each in study.factors:
        if each.kind == "model":
            for level in each.factor.levels:
                yield level, (str(level),), each.places[level]
            return
    yield "", study.models, study.places.get("model")


def _scenarios(study: Study) -> Iterator[tuple[Path, Span]]:
    """Yield the scenarios with their places in the file."""
    if study.scenario is not None:
        yield study.scenario, study.places["scenario"]
    for each in study.factors:
        if each.kind == "scenario":
            for level in each.factor.levels:
                yield study.folder / str(level), each.places[level]


def _placed(found: Diagnostic, place: Span | None) -> Diagnostic:
    """Give a diagnostic without a place, or about a command line, the place in the study."""
    nowhere = found.primary is None or found.primary.span.source.name == COMMAND_LINE
    return replace(found, primary=Label(place)) if nowhere and place is not None else found


def _check_measure(setting: Setting, report: Diagnostics) -> None:
    """Report a measure that a model does not have."""
    study = setting.study
    place = study.places.get("measure")
    for model in setting.models:
        known = measures(model.subject)
        name = study.measure or FITNESS
        if name in known:
            continue
        owner = f"`{model.subject.name}`"
        if known:
            help_ = f'it has {", ".join(f"`{each}`" for each in known)}: `measure = "..."`'
        else:
            help_ = "give the swarm a `fitness`, or the model a `property`"
        report.report("no-such-measure", place, name=name, owner=owner, help=help_)
    if not report.has_errors and study.goal is None and _kind(setting) == "measure":
        help_ = 'say what is better: `goal = "maximize"` or `goal = "minimize"`'
        report.report("missing-key", place, name="goal", help=help_)


def _kind(setting: Setting) -> str:
    return measures(setting.first.subject)[setting.study.measure or FITNESS]


def goal_of(setting: Setting) -> Goal:
    """Return what is better: the goal in the file, or that of the fitness; true of a property."""
    fitness = fitness_of(setting.first.subject)
    if setting.study.goal is not None:
        return setting.study.goal
    if _kind(setting) == "fitness" and fitness is not None and fitness.goal == "minimize":
        return "minimize"
    return "maximize"


def _check_levels(setting: Setting, report: Diagnostics) -> None:
    """Report levels that do not fit the models and scenarios, each once and at its place.

    A level is wrong if it is so alone and together with the first levels of the others: another
    factor may give a param its value.
    """
    study = setting.study
    base = tuple(each.factor.at(0.0) for each in study.factors)
    documents: dict[str, Document] = {}
    for number, each in enumerate(study.factors):
        alone = {at for at in range(len(base)) if study.factors[at].kind == "setting"} - {number}
        for value in _tried(each):
            point = (*base[:number], value, *base[number + 1 :])
            found = _mistakes(setting, point, documents)
            if not found:
                continue
            found = _mistakes(setting, point, documents, alone)
            if found and _report_level(each, value, found, report) is each.place:
                break  # it is the name that is wrong
    together = _mistakes(setting, base, documents)
    if together and not report.has_errors:
        first = study.factors[0]
        _report_level(first, base[0], together, report)


def _tried(varied: Varied) -> tuple[Value, ...]:
    factor = varied.factor
    return factor.levels or (factor.low, factor.high)


def _mistakes(
    setting: Setting,
    point: Point,
    documents: dict[str, Document],
    without: Collection[int] = (),
) -> list[Diagnostic]:
    """Return what is wrong with a point in its model and scenario, as a worker would find it.

    Settings of the factors in `without` are left out.
    """
    model, name = setting.model(point), setting.scenario(point)
    report = Diagnostics()
    if name not in documents:
        text = model.shipment.scenarios.get(name, "")
        source = Source(name, text, Path(name)) if name else EMPTY.source
        documents[name] = parse_toml(source, report) or EMPTY
    subject = model.subject
    scenario = apply_candidate(setting.candidate(point, without), documents[name], subject, report)
    if scenario is not None:
        kind = setting.study.world or scenario.world
        spaces = choose_space(kind, subject, scenario, report)
        if not report.has_errors:
            Prepared(subject, scenario, None, spaces).stage(report)
    return [each for each in report if each.severity is Severity.ERROR]


def _report_level(
    varied: Varied, value: Value, mistakes: list[Diagnostic], report: Diagnostics
) -> Span | None:
    """Report why a level does not fit; return its place, None if a scenario itself is wrong."""
    in_scenarios = [
        each
        for each in mistakes
        if each.primary is not None and each.primary.span.source.path is not None
    ]
    if in_scenarios:
        report.include(in_scenarios)
        return None
    found = mistakes[0]
    place = varied.places.get(value, varied.place)
    if found.name in ("unresolved-name", "unknown-key") and varied.kind == "setting":
        place = varied.place
    report.report(
        "unfit-level",
        place,
        name=varied.name,
        value=varied.text(value),
        reason=found.message,
        help=found.help,
    )
    return place
