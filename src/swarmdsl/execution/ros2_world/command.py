"""`swarmc simulate --ros2`: serve the robots of a swarm to their nodes, and print the results."""

from __future__ import annotations

import gc
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path

import click

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.diagnostics.render import counted
from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.base.write_stream import report_unwritten, write_stream
from swarmdsl.execution.ros2_world.drive import drive, wait_for_nodes
from swarmdsl.execution.ros2_world.graph import RclpyGraph, is_there
from swarmdsl.execution.ros2_world.ports import MissingInterfaceError
from swarmdsl.execution.ros2_world.served import ServedWorld
from swarmdsl.execution.simulate.evaluation.measures import fitness_of
from swarmdsl.execution.simulate.evaluation.properties import watchable
from swarmdsl.execution.simulate.evaluation.results import as_document
from swarmdsl.execution.simulate.evaluation.summary import (
    format_table,
    measure_table,
    property_table,
)
from swarmdsl.execution.simulate.evaluation.verdicts import Recording, report_violations
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.pictures.run_map import Maps
from swarmdsl.execution.simulate.run.live import show
from swarmdsl.execution.simulate.run.prepare import Prepared, Request, prepare
from swarmdsl.execution.simulate.scenario.durations import SECOND, format_duration
from swarmdsl.execution.simulate.scenario.scenario import Scenario
from swarmdsl.execution.simulate.scenario.space import ModelError
from swarmdsl.execution.simulate.world.runner import DEFAULT_UNTIL
from swarmdsl.execution.space.setting import Setting

Tell = Callable[[Diagnostics], None]
_SOURCE = "source a ROS 2, `. /opt/ros/<distribution>/setup.sh`, whose Python runs swarmc"
_BUILD = "build the interfaces of the model with colcon, and source `install/setup.sh`"
_ENDINGS = {
    "ended": "until all machines had ended",
    "stopped": "until the time was over",
}


def serve(request: Request, tell: Tell) -> bool | None:
    """Serve the robots; return True without errors, None if interrupted."""
    report = Diagnostics()
    if not is_there():
        report.report("no-ros", reason="there is no rclpy", help=_SOURCE)
        tell(report)
        return False
    prepared = prepare(request, report)
    if prepared is not None:
        _check(prepared, report)
        cast, _ = prepared.stage(report)
    if prepared is None or report.has_errors:
        tell(report)
        return False
    assert prepared.spaces.setting is not None
    tell(report)
    return _Served(request, prepared, cast, prepared.spaces.setting).play(tell)


def _check(prepared: Prepared, report: Diagnostics) -> None:
    """Report what cannot be served."""
    if prepared.subject.swarm is None:
        report.report("no-ros", reason="only robots of a swarm have places and namespaces")
    elif prepared.spaces.setting is None and not report.has_errors:
        report.report("no-ros", reason="its robots are nowhere", help="`--world flat` places them")
    for reason in _unserved(prepared.scenario, prepared):
        report.report("no-ros", reason=reason, help="leave it out of the scenario")


def _unserved(scenario: Scenario, prepared: Prepared) -> Iterator[str]:
    system = prepared.subject.system
    known = {each.name for each in system.events if not each.predefined} if system else set()
    for message in scenario.messages:
        if message.event not in known:
            yield f"`{message.event}` of the scenario is on no topic"
    for fault in scenario.faults:
        if fault.function is not None:
            yield f"`silent` of `{fault.function}` is a fault of a server"
        elif fault.is_loss and fault.lasts is not None:
            yield "a lost robot cannot come back: its nodes go on"


class _Served:
    """A run with its outputs."""

    def __init__(
        self,
        request: Request,
        prepared: Prepared,
        cast: Sequence[Actor],
        setting: Setting,
    ) -> None:
        scenario = prepared.scenario
        self._request = request
        self._prepared = prepared
        self._subject = prepared.subject
        self._cast = cast
        self._setting = setting
        self._seed = request.seed if request.seed is not None else scenario.seed
        until = request.until if request.until is not None else scenario.until
        self._until = until if until is not None else DEFAULT_UNTIL
        self._written: list[Path] = []

    def play(self, tell: Tell) -> bool | None:
        gc.enable()
        report = Diagnostics()
        graph = RclpyGraph()
        try:
            return self._play(graph, report, tell)
        except MissingInterfaceError as error:
            report.report("no-ros", reason=f"interface `{error}` is not installed", help=_BUILD)
        except OSError as error:
            if error.filename is None:
                raise
            report_unwritten(Path(error.filename), error, report)
        finally:
            graph.close()
        tell(report)
        return False

    def _play(self, graph: RclpyGraph, report: Diagnostics, tell: Tell) -> bool | None:
        space = self._prepared.spaces.alone(self._seed)
        world = ServedWorld(
            self._subject,
            self._prepared.scenario,
            self._cast,
            self._setting,
            space,
            self._seed,
            graph,
        )
        ending, interrupted = "until it was interrupted", False
        with ExitStack() as stack:
            if self._request.trace_file is not None:
                stream = stack.enter_context(write_stream(self._request.trace_file))
                world.recorded.listeners.append(lambda line: print(line, file=stream))
                self._written.append(self._request.trace_file)
            world.listen(graph)
            maps = Maps(self._request.map, self._request.animation)
            pictures = [stack.enter_context(write_stream(path)) for path in maps.paths]
            self._written += maps.paths
            drawn = maps.record(self._subject, world) if pictures else None
            show_end = self._show(world, stack)
            try:
                wait_for_nodes(world, graph, self._tell_missing)
                step = self._setting.layout.step
                ending = _ENDINGS[drive(world, graph, step, self._until, self._request.factor)]
            except KeyboardInterrupt:
                interrupted = True
            except ModelError as error:
                ending = "until the model of a function failed"
                time = format_duration(world.clock.now)
                function, reason = error.function, error.reason
                report.report("failed-model", function=function, time=time, reason=reason)
            show_end()
            if drawn is not None:
                for file, picture in zip(pictures, maps.drawn(drawn), strict=True):
                    file.write(picture)
            now = world.clock.now
            watched = [e for e in watchable(self._subject) if self._request.watches(e.name)]
            recording = Recording(watched, fitness_of(self._subject))
            fresh, _ = self._prepared.stage(Diagnostics())
            results, fitness = world.recorded.judge(
                self._subject, fresh, recording, now, space, report
            )
            if self._request.results is not None:
                head = {
                    "subject": self._subject.name,
                    "seed": self._seed,
                    "seconds": now / SECOND,
                    "ending": ending.removeprefix("until "),
                }
                document = stack.enter_context(write_stream(self._request.results))
                document.write(as_document(head, results, fitness))
                self._written.append(self._request.results)
        for reason, count in world.failures.items():
            times = "once" if count == 1 else f"{count} times"
            report.report("failed-expression", machine="a node", reason=reason, notes=(times,))
        report_violations(results, report)
        tell(report)
        for line in self._summary(world, ending):
            click.echo(line, err=True)
        for line in (*property_table(results), *measure_table(fitness)):
            click.echo(line, err=True)
        if self._written:
            names = [printable(str(path)) for path in self._written]
            click.echo(f"written: {', '.join(names)}", err=True)
        return None if interrupted else not report.has_errors

    def _show(self, world: ServedWorld, stack: ExitStack) -> Callable[[], None]:
        """Open the page that shows the run, if requested; return what draws the end."""
        if self._request.live is None:
            return lambda: None
        page, draw = show(self._request.live, self._subject, world, is_flat=True, stack=stack)
        world.recorded.listeners.append(page.step)
        return draw

    def _summary(self, world: ServedWorld, ending: str) -> Iterator[str]:
        members = counted(len(world.robots), "member")
        time = f"{format_duration(world.clock.now)} of virtual time"
        yield f"{printable(self._subject.name)}, {members} of ROS 2: {time}, {ending}"
        yield ""
        head, *moved = world.space.rows() or ((),)
        yield from format_table(head, moved)
        yield from format_table(("function", "end", "times"), _ends(world.outcomes), left=2)
        if world.holds.given_up:
            count = counted(world.holds.given_up, "time")
            yield f"time went on without an answer of a node, after a second: {count}"
            yield ""

    def _tell_missing(self, missing: list[str]) -> None:
        names = ", ".join(missing) or "nodes with `use_sim_time`"
        click.echo(f"waiting for {names}: `ros2 launch` their package with `world:=true`", err=True)


def _ends(outcomes: Counter[tuple[str, str]]) -> Iterator[tuple[str, str, str]]:
    for (function, outcome), count in sorted(outcomes.items()):
        yield function, outcome, str(count)
