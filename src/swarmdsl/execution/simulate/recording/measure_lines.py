"""Lines of a recording with the values of measures so far, and how a run ends."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from swarmdsl.execution.monitor import PropertyResult, Verdict, Watch
from swarmdsl.execution.simulate.evaluation.measures import FitnessResult, evaluate
from swarmdsl.execution.simulate.evaluation.results import fitness_values
from swarmdsl.execution.simulate.machines.json_numbers import named_numbers
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND, SECOND
from swarmdsl.execution.simulate.scenario.space import Space
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.ir import Fitness


class MeasureLines:
    """Tell the values of measures, at most once a second and if they have changed."""

    def __init__(self, fitness: Fitness, space: Space, write: Callable[[str], object]) -> None:
        self._fitness = fitness
        self._space = space
        self._write = write
        self._next = 0
        self._told: dict[str, Any] = {}

    def see(self, monitors: Watch, line: Line) -> None:
        """Write the values after a line that the monitors have seen."""
        if line.time >= self._next and monitors.has_begun:
            self._next = (line.time // SECOND + 1) * SECOND
            readings = monitors.readings(line.time)
            self.tell(line.time, evaluate(self._fitness, readings, self._space))

    def tell(self, time: int, result: FitnessResult) -> None:
        """Write the values at a time, if they are others than before."""
        values = named_numbers(fitness_values(result))
        if values != self._told:
            self._told = values
            self._write(_line(time, values))


def tell_results(
    results: Iterable[PropertyResult],
    told: Mapping[str, Verdict],
    time: int,
    write: Callable[[str], object],
) -> None:
    """Write the verdicts at the end that differ from those that were `told` before, or say more."""
    for each in results:
        if each.verdict != told.get(each.property.name) or each.remark:
            values: dict[str, Any] = {"property": each.property.name, "verdict": each.verdict}
            if each.remark:
                values["remark"] = each.remark
            write(_line(time, values))


def _line(time: int, values: Mapping[str, Any]) -> str:
    return f"{json.dumps({'t': time // MILLISECOND, **values}, ensure_ascii=False)}\n"
