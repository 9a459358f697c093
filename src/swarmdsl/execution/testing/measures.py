"""Expected measures of a test: `measures = { outside = ">= 0.5", elapsed = "< 10 min" }`."""

from __future__ import annotations

import math
import re

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.execution.simulate.evaluation.measures import (
    FitnessResult,
    fitness_of,
    inputs_of,
    value_text,
)
from swarmdsl.execution.simulate.inputs.scenario_table import Table
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import duration
from swarmdsl.ir.operations import OPERATIONS
from swarmdsl.syntax.types import DURATION

COMPARISON = "==|!=|<=|>=|<|>"
_WRITTEN = re.compile(rf"\s*({COMPARISON})?(.*)", re.DOTALL)
_NUMBER = re.compile(r"\s*[-+]?[0-9]+(?:\.[0-9]+)?(?:[eE][-+]?[0-9]+)?\s*")


@dataclass(frozen=True)
class ExpectedMeasure:
    """Comparison of a measure or the fitness; a time is in nanoseconds."""

    place: Span
    name: str
    comparison: str
    value: float
    is_time: bool

    @property
    def text(self) -> str:
        """Text of the comparison, with the value in its unit."""
        return f"`{self.name}` {self.comparison} {value_text(self.value, is_time=self.is_time)}"

    def differs(self, result: FitnessResult) -> str:
        """Return the actual value if it is another one, else an empty string."""
        if self.name == result.fitness.name:
            value, reached = result.value, True
        else:
            found = next(each for each in result.measures if each.input.name == self.name)
            value, reached = found.reading.value, found.reading.reached
        if value is None:
            return f"it has no value: {result.reason}" if result.reason else "it has no value"
        compared = OPERATIONS[self.comparison](value, self.value)
        # Without what was waited for, the time until it is longer than the run.
        if compared and (reached or self.comparison in (">", ">=", "!=")):
            return ""
        missed = "" if reached else ", when it had not happened"
        return f"it is {value_text(value, is_time=self.is_time)}{missed}"


def read_measures(table: Table, subject: Subject) -> tuple[ExpectedMeasure, ...]:
    """Read the expected measures of a test; report wrong ones."""
    if "measures" not in table:
        return ()
    inner = table.inside("measures")
    fitness = fitness_of(subject)
    if fitness is None:
        reason = f"`{subject.name}` has no fitness with measures"
        table.report.report("impossible-step", table.key_place("measures"), reason=reason)
        return ()
    types = {each.name: each.type == DURATION for each in inputs_of(fitness)}
    types[fitness.name] = False
    found = []
    for name in inner.values:
        if name not in types:
            inner.unknown(inner.key_place(name), name, types, "measure")
            continue
        expected = _expected(inner, name, is_time=types[name])
        if expected is not None:
            found.append(expected)
    return tuple(found)


def _expected(table: Table, name: str, *, is_time: bool) -> ExpectedMeasure | None:
    given = table.values[name]
    comparison = "=="
    value: float | None = None
    if isinstance(given, str):
        written = _WRITTEN.fullmatch(given)
        assert written is not None
        comparison, rest = written[1] or "==", written[2]
        if is_time:
            value = duration(rest)
        elif _NUMBER.fullmatch(rest):
            value = float(rest)
    elif isinstance(given, (int, float)) and not isinstance(given, bool) and not is_time:
        value = given
    if value is None or not math.isfinite(value):
        example = '"<= 10 min"' if is_time else '">= 3"'
        table.wrong((name,), f"a comparison like {example}", given)
        return None
    return ExpectedMeasure(table.value_place((name,)), name, comparison, value, is_time)
