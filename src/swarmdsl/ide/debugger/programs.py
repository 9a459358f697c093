"""Programs of a debug session, and the run of a model as one."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.execution.engine import LoopError, Machine
from swarmdsl.execution.monitor import FALSE
from swarmdsl.execution.simulate.evaluation.properties import plan, watch, watchable
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.run.prepare import Prepared, Request, prepare
from swarmdsl.execution.simulate.scenario.durations import duration
from swarmdsl.execution.simulate.scenario.space import ModelError
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.simulate.world.runner import Pace, run
from swarmdsl.execution.simulate.world.world import World
from swarmdsl.ide.debugger.messages import Arguments, RequestError, as_path, optional, texts


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

    def reach(self, step: Span) -> None:
        """Follow that a step of a test begins."""

    def judged(self, result: Mapping[str, Any]) -> None:
        """Follow the result of a test."""

    def tell(self, text: str) -> None:
        """Show a line to the user."""

    def poll(self) -> None:
        """Let the user act while nothing is on the stage."""


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


def load_model(arguments: Arguments, folder: Path, report: Diagnostics) -> ModelProgram | None:
    """Load the model of a launch; None if the model has errors, which are reported.

    Raises RequestError for wrong arguments.
    """
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
        distinct_machines(cast),
        seed if seed is not None else scene.seed,
        until if until is not None else scene.until,
    )


def distinct_machines(cast: Iterable[Actor]) -> list[Machine]:
    """Return the machines of a cast, each once."""
    return list({id(actor.machine): actor.machine for actor in cast}.values())


def _until(arguments: Arguments) -> int | None:
    text = optional(arguments, "until", str)
    length = duration(text) if text else None
    if text and length is None:
        raise RequestError("`until` must be a duration like `90s`, `500ms` or `10min`")
    return length
