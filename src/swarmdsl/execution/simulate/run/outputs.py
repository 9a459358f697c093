"""Outputs of a run: its trace, pictures of it, and a page that shows it."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import TextIO

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.base.write_stream import report_unwritten, write_stream
from swarmdsl.execution.monitor import Property, PropertyResult, Verdict, Watch
from swarmdsl.execution.simulate.evaluation.measures import FitnessResult
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.network.packets import Transmission
from swarmdsl.execution.simulate.pictures.timeline import Timeline
from swarmdsl.execution.simulate.recording.measure_lines import MeasureLines, tell_results
from swarmdsl.execution.simulate.recording.moved_lines import MovedLines
from swarmdsl.execution.simulate.recording.run_lines import RunLines
from swarmdsl.execution.simulate.recording.scene_lines import SceneLines
from swarmdsl.execution.simulate.run.prepare import STANDARD_INPUT, Prepared, Request
from swarmdsl.execution.simulate.scenario.space import NoPictureError
from swarmdsl.execution.simulate.world.line import Line, as_json, as_text
from swarmdsl.execution.simulate.world.world import World
from swarmdsl.ir import Fitness


class Outputs:
    """Requested outputs of a run; `listeners` of its world get those that follow it."""

    def __init__(
        self,
        request: Request,
        prepared: Prepared,
        cast: Sequence[Actor],
        world: World,
        listeners: list[Callable[[Line], None]],
        seed: int,
    ) -> None:
        self.written: list[Path] = []
        """Files that have been opened."""
        self._request = request
        self._subject = prepared.subject
        self._cast = cast
        self._world = world
        self._listeners = listeners
        self._is_flat = prepared.spaces.is_flat
        scenario = request.scenario
        of = f"scenario {printable(scenario.name)}, " if scenario is not None else ""
        self._conditions = f"{of}seed {seed}"
        self._history: dict[str, list[tuple[int, Verdict]]] = {}
        """Verdicts so far by property, each with the time from which on it held."""
        self._measures: MeasureLines | None = None

    def trace(self, stack: ExitStack, report: Diagnostics) -> TextIO | None:
        """Return the stream for the trace."""
        path = self._request.trace_file
        if self._request.trace == "none":
            return None
        if path is None:
            # A person watches the live table or types events instead.
            watched = sys.stdout.isatty() and self._request.events != STANDARD_INPUT
            return None if watched and self._request.trace is None else sys.stdout
        return self.write_to(path, stack, report)

    def verdict_listener(self) -> Callable[[Property, Verdict, int], None] | None:
        """Return what notes verdicts so far for the outputs, if one shows them.

        The recorder, if there is one, keeps all lines from now on.
        """
        recorder = self._request.recorder
        if recorder is None and self._request.timeline is None:
            return None
        lines = RunLines(self._world, recorder.write) if recorder is not None else None
        if recorder is not None and lines is not None:
            recorder.begin(self._subject, self._cast, self._request.scenario, self._world)
            self._listeners.append(lines.step)
            self._tell_transmissions(lines.transmitted)
            self._world.space.viewers += (
                MovedLines(self._world, recorder.write),
                SceneLines(self._world, recorder.write),
            )

        def note(property_: Property, verdict: Verdict, time: int) -> None:
            self._history.setdefault(property_.name, []).append((time, verdict))
            if lines is not None:
                lines.verdict(property_.name, verdict, time)

        return note

    def follow_measures(self, monitors: Watch, fitness: Fitness | None) -> None:
        """Let the recorder have the values of measures; the monitors are listeners already."""
        recorder = self._request.recorder
        if recorder is not None and fitness is not None:
            self._measures = MeasureLines(fitness, self._world.space, recorder.write)
            self._listeners.append(partial(self._measures.see, monitors))

    def end_recording(
        self, results: Sequence[PropertyResult], fitness: FitnessResult | None
    ) -> None:
        """Tell the recorder how the run ended, if there is one."""
        recorder, now = self._request.recorder, self._world.clock.now
        if recorder is None:
            return
        told = {name: changes[-1][1] for name, changes in self._history.items()}
        tell_results(results, told, now, recorder.write)
        if self._measures is not None and fitness is not None:
            self._measures.tell(now, fitness)
        recorder.end(now)

    def timeline(
        self, stack: ExitStack, report: Diagnostics
    ) -> Callable[[Mapping[str, str]], object] | None:
        """Prepare drawing the timeline with remarks on properties, if requested."""
        if self._request.timeline is None:
            return None
        stream = self.write_to(self._request.timeline, stack, report)
        if stream is None:
            return None
        timeline = Timeline(self._subject.name, self._cast, self._conditions)
        self._listeners.append(timeline.note)
        self._tell_transmissions(timeline.transmitted)
        return lambda remarks: stream.write(
            timeline.svg(self._world.clock.now, self._history, remarks)
        )

    def _tell_transmissions(self, listener: Callable[[Transmission], None]) -> None:
        """Call one more listener with each swarm event in transit."""
        before = self._world.network.transmitted

        def tell(crossing: Transmission) -> None:
            if before is not None:
                before(crossing)
            listener(crossing)

        self._world.network.transmitted = tell

    def maps(self, stack: ExitStack, report: Diagnostics) -> Callable[[], None]:
        """Prepare drawing the map and the animation, as far as they are requested."""
        if self._request.map is None and self._request.animation is None:
            return lambda: None
        from swarmdsl.execution.simulate.pictures.run_map import Maps

        maps = Maps(self._request.map, self._request.animation)
        streams = [self.write_to(path, stack, report) for path in maps.paths]
        recorded = maps.record(self._subject, self._world)
        self._listeners.append(recorded.stepped)

        def draw() -> None:
            for stream, picture in zip(streams, maps.drawn(recorded), strict=True):
                assert stream is not None
                stream.write(picture)

        return draw

    def draw_robots(self, stack: ExitStack, report: Diagnostics) -> None:
        """Write a picture of the robots at the end, if requested."""
        path = self._request.picture
        if path is None:
            return
        try:
            picture = self._world.space.picture()
        except NoPictureError as error:
            report.report("no-picture", reason=str(error), help="use `--map` instead")
            return
        stream = self.write_to(path, stack, report)
        if stream is not None and picture is not None:
            stream.buffer.write(picture)

    def live(self, stack: ExitStack) -> Callable[[], None]:
        """Open the page that shows the run, if requested; return what draws the end."""
        if self._request.live is None:
            return lambda: None
        from swarmdsl.execution.simulate.run.live import show

        page, draw = show(
            self._request.live, self._subject, self._world, is_flat=self._is_flat, stack=stack
        )
        self._listeners.append(lambda line: page.step(as_json(line)))
        return draw

    def write_to(self, path: Path, stack: ExitStack, report: Diagnostics) -> TextIO | None:
        """Open a file for as long as the stack lasts; report one that cannot be written."""
        try:
            stream = stack.enter_context(write_stream(path))
        except OSError as error:
            report_unwritten(path, error, report)
            return None
        self.written.append(path)
        return stream

    def writer(self, stream: TextIO) -> Callable[[Line], None]:
        """Return what writes each line of the trace."""
        kind = self._request.trace or ("json" if self._request.trace_file is not None else "text")
        width = max(len(actor.name or "") for actor in self._cast)
        form = as_json if kind == "json" else partial(as_text, width=width)
        at_once = self._request.real_time or self._request.events == STANDARD_INPUT
        if kind == "json" and self._request.trace_file is not None:
            self._world.space.viewers += (MovedLines(self._world, stream.write),)

        def write(line: Line) -> None:
            stream.write(f"{form(line)}\n")
            if at_once:
                stream.flush()

        return write
