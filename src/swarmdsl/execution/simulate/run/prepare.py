"""Load the subject of a simulation, its scenario, and the events from outside."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import MOST_DATA, MOST_RECORDED
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source
from swarmdsl.driver import pipeline
from swarmdsl.driver.config import Settings, find_settings
from swarmdsl.execution.scxml import read as read_scxml
from swarmdsl.execution.simulate.inputs.choose_space import Spaces, choose_space
from swarmdsl.execution.simulate.inputs.events import Input, Reader
from swarmdsl.execution.simulate.inputs.load_scenario import load_scenario
from swarmdsl.execution.simulate.machines.actors import Actor, actors
from swarmdsl.execution.simulate.machines.subject import Document, Subject, choose
from swarmdsl.execution.simulate.recording.run_lines import Recorder
from swarmdsl.execution.simulate.run.live import Opened
from swarmdsl.execution.simulate.scenario.scenario import Scenario
from swarmdsl.ir import System
from swarmdsl.project.loader import Project
from swarmdsl.project.read_source import read_source

STANDARD_INPUT = "-"
"""Name of standard input as a file of events."""


@dataclass(frozen=True)
class Request:
    """Arguments of the command."""

    paths: tuple[Path, ...]
    machine: str | None = None
    swarm: str | None = None
    events: str | None = None
    scenario: Path | None = None
    trace: str | None = None
    trace_file: Path | None = None
    timeline: Path | None = None
    seed: int | None = None
    until: int | None = None
    real_time: bool = False
    replay: tuple[Path, ...] = ()
    properties: bool = True
    stop_on_violation: bool = False
    only: tuple[str, ...] = ()
    """Names of the properties that are watched; none for all."""
    results: Path | None = None
    world: str | None = None
    """Kind of space; None if the scenario or the model decides."""
    map: Path | None = None
    animation: Path | None = None
    picture: Path | None = None
    """File for a picture of the robots at the end, in physics."""
    factor: float = 1.0
    """Speed of virtual time in a run in real time."""
    live: Opened | None = None
    """Opens the page that shows the run."""
    recorder: Recorder | None = None
    """Keeps the lines of the run."""

    def watches(self, name: str) -> bool:
        """Return True if a property of this name is watched."""
        return self.properties and (not self.only or name in self.only)


@dataclass(frozen=True)
class Prepared:
    """Subject of a run with its scenario, and its events from outside, if they are in a file."""

    subject: Subject
    scenario: Scenario
    events: Source | None
    spaces: Spaces

    def stage(self, report: Diagnostics) -> tuple[list[Actor], list[Input]]:
        """Return the machines of a run, which changes them, and its events from outside."""
        robots = self.subject.create_robots(self.scenario.counts, self.scenario.alone)
        cast = actors(self.subject, robots, self.scenario, report)
        if report.has_errors or self.events is None:
            return cast, []
        return cast, Reader(self.subject, cast, report).file(self.events)


def prepare(request: Request, report: Diagnostics) -> Prepared | None:
    """Load and check everything before a run."""
    subject = _subject(request, report)
    if subject is None:
        return None
    scenario = load_scenario(request.scenario, subject, report)
    if scenario is None:
        return None
    events: Source | None = None
    if request.events is not None and request.events != STANDARD_INPUT:
        path = Path(request.events)
        events = read_source(path, None, report, "a file of events", MOST_RECORDED)
    kind = request.world or scenario.world
    spaces = Spaces() if request.replay else choose_space(kind, subject, scenario, report)
    if (request.map or request.animation) and not spaces.is_flat and not report.has_errors:
        help_ = "say where something is in the model, or run it with `--world flat`"
        report.report("no-positions", name=subject.name, help=help_)
    if request.picture is not None and kind != "physics" and not report.has_errors:
        reason = "only the world `physics` has bodies to draw"
        report.report("no-picture", reason=reason, help="add `--world physics`, or use `--map`")
    return None if report.has_errors else Prepared(subject, scenario, events, spaces)


def _subject(request: Request, report: Diagnostics) -> Subject | None:
    """Load the models and documents, and choose the subject."""
    documents = [path for path in request.paths if path.suffix == ".scxml"]
    models = [path for path in request.paths if path not in documents]
    read = [document for path in documents if (document := _document(path, report)) is not None]
    system: System | None = None
    project: Project | None = None
    settings = Settings()
    if models or not documents:
        settings = find_settings(models, report)
        if report.has_errors:
            return None
        checked = pipeline.check(models or settings.sources, settings)
        report.include(checked.report)
        system, project = checked.system, checked.valid
    if report.has_errors:
        return None
    subject = choose(system, read, request.machine, request.swarm, report, request.only)
    if subject is not None:
        subject.models = settings.models
        subject.project = project
    return subject


def _document(path: Path, report: Diagnostics) -> Document | None:
    source = read_source(path, None, report, most=MOST_DATA)
    machine = read_scxml(source, report) if source is not None else None
    return Document(source, machine) if source is not None and machine is not None else None
