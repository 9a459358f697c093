"""`swarmc simulate`: load models, run them and print the results."""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from itertools import chain
from pathlib import Path
from queue import SimpleQueue
from threading import Thread

import click

from swarmdsl.base.diagnostics.collector import Diagnostics, Label, listed
from swarmdsl.base.diagnostics.render import counted
from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.base.read_files import MOST_RECORDED, lines_of
from swarmdsl.base.write_stream import report_unwritten
from swarmdsl.execution.engine import LoopError
from swarmdsl.execution.monitor import PropertyResult, ViolatedError
from swarmdsl.execution.simulate.evaluation.measures import (
    FitnessResult,
    evaluate,
    fitness_of,
    measures_of,
)
from swarmdsl.execution.simulate.evaluation.properties import plan, watch, watchable
from swarmdsl.execution.simulate.evaluation.reporter import observe
from swarmdsl.execution.simulate.evaluation.results import as_document
from swarmdsl.execution.simulate.evaluation.summary import Summary, measure_table, property_table
from swarmdsl.execution.simulate.evaluation.verdicts import Recording, report_violations
from swarmdsl.execution.simulate.inputs.events import STDIN, Input, Reader
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.replay.replay import replay
from swarmdsl.execution.simulate.run.deadlock_hint import deadlock_hint
from swarmdsl.execution.simulate.run.outputs import Outputs
from swarmdsl.execution.simulate.run.prepare import STANDARD_INPUT, Prepared, Request, prepare
from swarmdsl.execution.simulate.scenario.durations import SECOND, format_duration
from swarmdsl.execution.simulate.scenario.space import ModelError
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.simulate.world.runner import DEFAULT_UNTIL, Ending, Pace, run, run_live
from swarmdsl.execution.simulate.world.world import World
from swarmdsl.project.read_source import read_source

Tell = Callable[[Diagnostics], None]
_ENDINGS: dict[Ending, str] = {
    "ended": "until all machines had ended",
    "quiet": "until nothing was left to happen",
    "stopped": "until the time was over",
}
_NO_LATENCY = ("members answer each other without delay: give the network a latency",)
_STANDARD_INPUT = 0
_AT_ONCE = 1 << 16
_MOST_SHOWN = 5
"""Maximum number of states shown of a loop."""


def simulate(request: Request, tell: Tell) -> bool | None:
    """Run a simulation; return True without errors, None if interrupted.

    Errors are printed as soon as they are known.
    """
    report = Diagnostics()
    prepared = _prepare(request, report)
    tell(report)
    if prepared is None:
        return False
    return prepared.replay(tell) if request.replay else prepared.play(tell)


def _prepare(request: Request, report: Diagnostics) -> _Play | None:
    """Load and check everything before the run."""
    prepared = prepare(request, report)
    if prepared is None:
        return None
    cast, inputs = prepared.stage(report)
    return None if report.has_errors else _Play(request, prepared, cast, inputs)


def _loop_shown(lines: int) -> str:
    if not lines:
        return "nothing happens after them"
    return (
        "the last line repeats for ever"
        if lines == 1
        else f"the last {lines} lines repeat for ever"
    )


def _typed_bytes() -> bytes:
    return os.read(_STANDARD_INPUT, _AT_ONCE)


class _Play:
    """A run with its outputs."""

    def __init__(
        self,
        request: Request,
        prepared: Prepared,
        cast: Sequence[Actor],
        inputs: Sequence[Input],
    ) -> None:
        subject, scenario = prepared.subject, prepared.scenario
        self._request = request
        self._subject = subject
        self._cast = cast
        self._inputs = inputs
        self._wrong = False
        self._until = request.until if request.until is not None else scenario.until
        self._seed = request.seed if request.seed is not None else scenario.seed
        self._watched = [each for each in watchable(subject) if request.watches(each.name)]
        self._fitness = fitness_of(subject)
        self._listeners: list[Callable[[Line], None]] = []
        self._world = World(
            subject.system,
            cast,
            scenario,
            self._seed,
            self._listeners,
            subject.heartbeat,
            prepared.spaces.alone(self._seed),
        )
        self._outputs = Outputs(request, prepared, cast, self._world, self._listeners, self._seed)

    def replay(self, tell: Tell) -> bool:
        """Compare each trace with the model; return True if all conform."""
        report = Diagnostics()
        several = len(self._request.replay) > 1
        for path in self._request.replay:
            source = read_source(path, None, report, "a trace", MOST_RECORDED)
            if source is None:
                continue
            before = len(report)
            recording = Recording(self._watched, self._fitness)
            found = replay(
                source,
                self._subject,
                self._cast,
                report,
                recording.see,
                self._world.scenario.faults,
            )
            results, fitness = recording.results(found.end, found.repeated)
            if not found.members and len(report) == before:
                report.report("empty-trace", path=path)
            report_violations(results, report)
            left_out = {"left_out": found.left_out} if found.left_out else {}
            conditions = {"replayed": str(path), "lines": found.lines, **left_out}
            self._write_results(conditions, results, fitness, report)
            which = f"{printable(str(path))}: " if several else ""
            lines, members = counted(found.lines, "line"), counted(found.members, "member")
            click.echo(f"{which}{lines} of {members} as in the model", err=True)
            if found.loop is not None:
                click.echo(_loop_shown(found.loop), err=True)
            tables = [*property_table(results), *measure_table(fitness)]
            if tables and found.left_out:
                click.echo(
                    f"left out of the following: {counted(found.left_out, 'line')}", err=True
                )
            for line in tables:
                click.echo(line, err=True)
        tell(report)
        return not report.has_errors

    def play(self, tell: Tell) -> bool | None:
        # The compiler disables garbage collection, but a run may be long.
        gc.enable()
        report = Diagnostics()
        interrupted = False
        ending = "until an endless loop"
        results: list[PropertyResult] = []
        summary = Summary(self._subject, self._world)
        fitness: FitnessResult | None = None
        monitors = watch(
            plan(self._watched, measures_of(self._fitness)),
            self._world.data,
            stops=self._request.stop_on_violation,
            told=self._outputs.verdict_listener(),
        )
        try:
            with ExitStack() as stack:
                stream = self._outputs.trace(stack, report)
                picture = self._outputs.timeline(stack, report)
                maps = self._outputs.maps(stack, report)
                if report.has_errors:
                    tell(report)
                    return False
                if stream is not None:
                    self._listeners.append(self._outputs.writer(stream))
                if stream is None or not stream.isatty():
                    self._show_board(stack)
                last = self._outputs.live(stack)
                watched = bool(self._watched) or self._fitness is not None
                if watched and self._listeners:
                    self._listeners.append(monitors.see)  # it can end the run
                    self._outputs.follow_measures(monitors, self._fitness)
                elif watched:
                    observe(self._world.trace, monitors, self._world.clock)
                try:
                    ending = _ENDINGS[self._run(tell)]
                except ViolatedError:
                    ending = "until a property was violated"
                except LoopError as error:
                    self._report_loop(error, report)
                except ModelError as error:
                    ending = "until the model of a function failed"
                    time = format_duration(self._world.clock.now)
                    function, reason = error.function, error.reason
                    report.report("failed-model", function=function, time=time, reason=reason)
                except KeyboardInterrupt:
                    interrupted, ending = True, "until it was interrupted"
                sys.stdout.flush()
                ended = ending == _ENDINGS["ended"]
                now = self._world.clock.now
                results = monitors.results(now, ended=ended)
                if self._fitness is not None:
                    # What has not happened when nothing is left to happen never will.
                    over = ended or ending == _ENDINGS["quiet"]
                    readings = monitors.readings(now, self._limit if over else now)
                    fitness = evaluate(self._fitness, readings, self._world.space)
                if picture is not None:
                    picture({each.property.name: each.remark for each in results})
                maps()
                self._outputs.draw_robots(stack, report)
                self._outputs.end_recording(results, fitness)
                last()
        except OSError as error:
            if error.filename is None:
                raise  # of standard output
            report_unwritten(Path(error.filename), error, report)
        for (machine, reason), count in self._world.failures.items():
            times = "once" if count == 1 else f"{count} times"
            report.report("failed-expression", machine=machine, reason=reason, notes=(times,))
        report_violations(results, report)
        self._write_results(self._conditions(ending), results, fitness, report)
        tell(report)
        for line in summary.text(ending, results, fitness, brief=bool(self._request.only)):
            click.echo(line, err=True)
        request = self._request
        unplayed = request.events is None and request.scenario is None
        if unplayed and ending == _ENDINGS["quiet"] and (awaited := summary.awaited):
            start = request.paths[0] if request.paths else Path()
            click.echo(f"\n{deadlock_hint(awaited, self._subject, start)}", err=True)
        if self._outputs.written:
            names = [printable(str(path)) for path in self._outputs.written]
            click.echo(f"\nwritten: {', '.join(names)}", err=True)
        return None if interrupted else not (report.has_errors or self._wrong)

    def _conditions(self, ending: str) -> dict[str, object]:
        """Return what led to the results of a run."""
        scenario = self._request.scenario
        return {
            "scenario": str(scenario) if scenario is not None else None,
            "seed": self._seed,
            "seconds": self._world.clock.now / SECOND,
            "ending": ending.removeprefix("until "),
        }

    def _write_results(
        self,
        conditions: Mapping[str, object],
        results: Sequence[PropertyResult],
        fitness: FitnessResult | None,
        report: Diagnostics,
    ) -> None:
        """Write the results of a run or of a replayed trace, if requested."""
        path = self._request.results
        if path is None:
            return
        head = {"subject": self._subject.name, **conditions}
        try:
            with ExitStack() as stack:
                stream = self._outputs.write_to(path, stack, report)
                if stream is not None:
                    stream.write(as_document(head, results, fitness))
        except OSError as error:
            report_unwritten(path, error, report)

    def _run(self, tell: Tell) -> Ending:
        pace = Pace(self._request.factor) if self._request.real_time else None
        if self._request.events != STANDARD_INPUT:
            return run(self._world, self._inputs, self._until, pace)
        if pace is None:
            return run(self._world, self._typed(tell), self._until)
        arrivals: SimpleQueue[Input | None] = SimpleQueue()
        Thread(target=self._queue, args=(tell, arrivals), daemon=True).start()
        return run_live(self._world, arrivals, self._until, pace)

    @property
    def _limit(self) -> int:
        """Time at which the run must end."""
        last = sum(each.after for each in self._inputs)
        return self._until if self._until is not None else last + DEFAULT_UNTIL

    def _show_board(self, stack: ExitStack) -> None:
        """Show the live table, if the terminal is not used otherwise."""
        if not sys.stderr.isatty() or self._request.events == STANDARD_INPUT:
            return
        from rich.console import Console

        from swarmdsl.execution.simulate.run.live_table import Board

        board = Board(self._cast, self._world.clock, self._limit, Console(stderr=True))
        self._listeners.append(board.note)
        stack.enter_context(board.display())

    def _typed(self, tell: Tell) -> Iterator[Input | None]:
        """Yield the events on standard input; report errors immediately."""
        reader = Reader(self._subject, self._cast, Diagnostics())
        try:
            for each in reader.stream(chain.from_iterable(lines_of(_typed_bytes))):
                self._report_and_clear(reader, tell)
                yield each
        except OSError as error:
            reader.report.report("unreadable-file", path=STDIN, reason=str(error.strerror).lower())
            self._report_and_clear(reader, tell)

    def _report_and_clear(self, reader: Reader, tell: Tell) -> None:
        if len(reader.report):
            tell(reader.report)
            self._wrong |= reader.report.has_errors
            reader.report = Diagnostics()

    def _queue(self, tell: Tell, arrivals: SimpleQueue[Input | None]) -> None:
        for each in self._typed(tell):
            if each is not None:
                arrivals.put(each)
        arrivals.put(None)

    def _report_loop(self, error: LoopError, report: Diagnostics) -> None:
        """Report an endless loop, with the states in it."""
        actor, now = self._world.trace.actor, self._world.clock.now
        machine = actor.machine
        origins = [machine.states[machine.numbers[state]].origin for state in error.states]
        places = [p for p in map(self._subject.place, origins) if p is not None]
        states = listed(error.states[:_MOST_SHOWN], "or")
        report.report(
            "never-settles",
            places[0] if places else None,
            label="the loop goes through this state",
            related=tuple(Label(place, "and here") for place in places[1:_MOST_SHOWN]),
            notes=_NO_LATENCY if self._subject.swarm is not None else (),
            who=f"`{actor.name or machine.name}`",
            time=format_duration(now),
            help=f"add an event or a delay to a transition of {states}",
        )
