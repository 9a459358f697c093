"""Programs of a debug session: the run of a model, or of one behaviour test."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import MOST_DATA
from swarmdsl.base.records import dataclass
from swarmdsl.execution.engine import LoopError, Machine
from swarmdsl.execution.monitor import FALSE
from swarmdsl.execution.simulate.actors import Actor, actors
from swarmdsl.execution.simulate.durations import duration
from swarmdsl.execution.simulate.prepare import Prepared, Request, prepare
from swarmdsl.execution.simulate.properties import plan, watch, watchable
from swarmdsl.execution.simulate.run import Pace, run
from swarmdsl.execution.simulate.space import ModelError
from swarmdsl.execution.simulate.subject import Subject
from swarmdsl.execution.simulate.trace import Line
from swarmdsl.execution.simulate.world import World
from swarmdsl.execution.testing.case import Case, InvalidTest
from swarmdsl.execution.testing.models import Models
from swarmdsl.execution.testing.reading import read_tests
from swarmdsl.execution.testing.run_case import Failure, run_case
from swarmdsl.ide.debugger.messages import Arguments, RequestError, as_path, optional, texts
from swarmdsl.project.read_source import read_source


class Stage(Protocol):
    """Follower of a run, which can hold it in each call."""

    pace: Pace

    def begin(self, cast: Sequence[Actor], world: World) -> None:
        """Note who runs, before the world begins."""

    def see(self, line: Line) -> None:
        """Follow the end of a macrostep."""

    def rest(self) -> bool:
        """Follow that nothing is left to happen; return True to end then."""

    def violated(self, name: str) -> None:
        """Follow the violation of a property."""

    def fail(self, why: str) -> None:
        """Follow the failure of a run."""


class Program(Protocol):
    """Program that can be run any number of times, always the same."""

    @property
    def subject(self) -> Subject:
        """The swarm or machine that runs."""

    @property
    def machines(self) -> Collection[Machine]:
        """The machines of its robots, each once."""

    def play(self, stage: Stage) -> str:
        """Run once; return why it is over."""


@dataclass(frozen=True)
class ModelProgram:
    """Simulation of a model, as `swarmc simulate` runs it."""

    prepared: Prepared
    machines: Collection[Machine]
    seed: int
    until: int | None

    @property
    def subject(self) -> Subject:
        """The swarm or machine that runs."""
        return self.prepared.subject

    def play(self, stage: Stage) -> str:
        """Run once; return why it is over."""
        subject, scenario = self.subject, self.prepared.scenario
        cast, inputs = self.prepared.stage(Diagnostics())
        listeners: list[Callable[[Line], None]] = []
        world = World(
            subject.system,
            cast,
            scenario,
            self.seed,
            listeners,
            subject.heartbeat,
            self.prepared.spaces.alone(self.seed),
        )
        watched = watchable(subject)
        if watched:
            monitors = watch(
                plan(watched),
                world.data,
                told=lambda property_, verdict, _: (
                    stage.violated(property_.name) if verdict == FALSE else None
                ),
            )
            listeners.append(monitors.see)
        listeners.append(stage.see)
        stage.begin(cast, world)
        try:
            ending = run(world, inputs, self.until, stage.pace)
            while ending == "quiet" and not world.over:
                # What the user sends goes on with the run.
                if stage.rest() and world.clock.next is None:
                    break
                while not world.over and (due := world.clock.next) is not None:
                    stage.pace.wait(due)
                    world.step()
        except LoopError as error:
            stage.fail(str(error))
            return "an endless loop"
        except ModelError as error:
            stage.fail(f"the model of `{error.function}` failed: {error.reason}")
            return "the model of a function failed"
        if world.over:
            return "all machines have ended"
        return "the time is over" if ending == "stopped" else "nothing is left to happen"


class TestProgram:
    """Run of one test with one seed."""

    __test__ = False  # for pytest, which would collect the class

    def __init__(self, case: Case, seed: int) -> None:
        self.subject = case.subject
        robots = case.subject.create_robots(case.scenario.counts, case.scenario.alone)
        self.machines = _machines(actors(case.subject, robots, case.scenario, Diagnostics()))
        self._case = case
        self._seed = seed

    def play(self, stage: Stage) -> str:
        """Run once; return why it is over."""
        failure = run_case(self._case, self._seed, stage.see, _Opened(stage)).failure
        if failure is None:
            return f"the test `{self._case.name}` passes"
        stage.fail(_described(failure))
        return f"the test `{self._case.name}` fails"


class _Opened:
    """Recorder of a test that keeps nothing: it tells the stage who runs."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage

    def begin(
        self, subject: Subject, cast: Sequence[Actor], scenario: Path | None, world: World
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
    place = failure.place.source.name
    return f"{place}:{failure.place.line}: {found.message}: {failure.label}"


def load(arguments: Arguments, folder: Path, report: Diagnostics) -> Program | None:
    """Load the program of a launch; None if the model has errors, which are reported.

    Raises RequestError for wrong arguments.
    """
    test = as_path(optional(arguments, "test", str) or "")
    if test:
        return _test(folder / test, arguments, report)
    names = texts(arguments, "program")
    if not names:
        raise RequestError("`program` is missing: the model to run, a file or a folder")
    scenario, events = (
        as_path(optional(arguments, name, str) or "") for name in ("scenario", "events")
    )
    world = optional(arguments, "world", str)
    if world not in (None, "", "abstract", "flat", "physics"):
        raise RequestError("`world` must be `abstract`, `flat` or `physics`")
    if optional(arguments, "machine", str) and optional(arguments, "swarm", str):
        raise RequestError("`machine` and `swarm` conflict")
    request = Request(
        tuple(folder / as_path(name) for name in names),
        machine=optional(arguments, "machine", str) or None,
        swarm=optional(arguments, "swarm", str) or None,
        events=str(folder / events) if events else None,
        scenario=folder / scenario if scenario else None,
        world=world or None,
    )
    prepared = prepare(request, report)
    if prepared is None:
        return None
    # Params without values and wrong events are found here.
    cast, _ = prepared.stage(report)
    if report.has_errors:
        return None
    seed = optional(arguments, "seed", int)
    until = _until(arguments)
    scene = prepared.scenario
    return ModelProgram(
        prepared,
        _machines(cast),
        seed if seed is not None else scene.seed,
        until if until is not None else scene.until,
    )


def _machines(cast: Iterable[Actor]) -> list[Machine]:
    return list({id(actor.machine): actor.machine for actor in cast}.values())


def _until(arguments: Arguments) -> int | None:
    text = optional(arguments, "until", str)
    length = duration(text) if text else None
    if text and length is None:
        raise RequestError("`until` must be a duration like `90s`, `500ms` or `10min`")
    return length


def _test(path: Path, arguments: Arguments, report: Diagnostics) -> Program | None:
    source = read_source(path, None, report, most=MOST_DATA)
    tests = read_tests(source, Models(), report) if source is not None else None
    if tests is None:
        return None
    cases: Mapping[str, Case | InvalidTest] = {each.name: each for each in tests.cases}
    name = optional(arguments, "testName", str) or next(iter(cases))
    case = cases.get(name)
    if case is None:
        raise RequestError(f"there is no test `{name}`, but {', '.join(map(_quoted, cases))}")
    if isinstance(case, InvalidTest):
        report.include(case.problems)
        return None
    seed = optional(arguments, "seed", int)
    return TestProgram(case, seed if seed is not None else case.seeds[0])


def _quoted(name: str) -> str:
    return f"`{name}`"
