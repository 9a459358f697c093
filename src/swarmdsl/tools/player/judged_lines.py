"""Lines with verdicts and measures that the monitors make of a trace, as of a simulated run."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from swarmdsl.execution.monitor import Property, Verdict
from swarmdsl.execution.simulate.evaluation.measures import fitness_of
from swarmdsl.execution.simulate.evaluation.properties import watchable
from swarmdsl.execution.simulate.evaluation.verdicts import Recording
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.recording.measure_lines import MeasureLines, tell_results
from swarmdsl.execution.simulate.replay.replay import Replayed
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND
from swarmdsl.execution.simulate.scenario.space import ABSTRACT
from swarmdsl.execution.simulate.world.line import Line


class Judge:
    """Collects the lines of a replayed trace for the monitors of its model."""

    def __init__(self, subject: Subject) -> None:
        self._fitness = fitness_of(subject)
        self._seen = Recording(watchable(subject), self._fitness)

    def see(self, line: Line, data: Mapping[str, Any], place: int) -> None:
        """Note a line with the data of its machine, and its place in the trace."""
        self._seen.see(line, data, place)

    def lines(self, replayed: Replayed) -> list[dict[str, Any]]:
        """Return lines with verdicts and measures, as `swarmc simulate --replay` judges."""
        found: list[dict[str, Any]] = []
        told: dict[str, Verdict] = {}

        def write(text: str) -> None:
            found.append(json.loads(text))

        def note(property_: Property, verdict: Verdict, time: int) -> None:
            told[property_.name] = verdict
            line = {"t": time // MILLISECOND, "property": property_.name, "verdict": verdict}
            found.append(line)

        measures = None
        if self._fitness is not None:
            measures = MeasureLines(self._fitness, ABSTRACT, write)
        heard = measures.see if measures is not None else None
        results, fitness = self._seen.results(
            replayed.end, replayed.repeated, told=note, heard=heard
        )
        tell_results(results, told, replayed.end, write)
        if measures is not None and fitness is not None:
            measures.tell(replayed.end, fitness)
        return found
