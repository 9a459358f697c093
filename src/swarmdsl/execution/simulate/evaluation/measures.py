"""Measures and fitness of a run."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain

from swarmdsl.base.records import dataclass
from swarmdsl.codegen.shared.constants import Value, constant, params_by_name
from swarmdsl.execution.engine import ExecutionError, bounded
from swarmdsl.execution.monitor import Reading
from swarmdsl.execution.simulate.machines.expressions import function_of
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import SECOND, format_duration
from swarmdsl.execution.simulate.scenario.space import ABSTRACT, Space
from swarmdsl.ir import Fitness, FitnessInput, Param, VariableRef, subexpressions
from swarmdsl.ir.integer_ranges import bound_of_any
from swarmdsl.syntax.types import DURATION


@dataclass(frozen=True)
class Measured:
    """Measure of a fitness at the end of a run."""

    input: FitnessInput
    reading: Reading

    @property
    def is_time(self) -> bool:
        """True if the value is in nanoseconds."""
        return self.input.type == DURATION

    @property
    def fault(self) -> str:
        """Return why the value is not one of the type of the input, else an empty string."""
        bound = bound_of_any(self.input.type)
        try:
            if bound is not None:
                bounded(self.reading.value, bound)
        except ExecutionError as error:
            return str(error)
        return ""


@dataclass(frozen=True)
class FitnessResult:
    """Fitness at the end of a run: its value, or the reason why it has none."""

    fitness: Fitness
    measures: tuple[Measured, ...]
    value: float | None
    reason: str = ""

    @property
    def unreached(self) -> tuple[str, ...]:
        """Names of the measures in the fitness that are only lower bounds."""
        parts = subexpressions(self.fitness.value)
        used = {part.name for part in parts if isinstance(part, VariableRef)}
        names = (each.input.name for each in self.measures if not each.reading.reached)
        return tuple(name for name in names if name in used)


def fitness_of(subject: Subject) -> Fitness | None:
    """Return the fitness of a swarm if something of it is measured."""
    system, swarm = subject.system, subject.swarm
    if system is None or swarm is None or swarm.fitness is None:
        return None
    found = next(each for each in system.fitness if each.name == swarm.fitness)
    return found if inputs_of(found) else None


def measures_of(fitness: Fitness | None) -> list[FitnessInput]:
    """Return the inputs of a fitness that monitors measure, in order."""
    inputs = fitness.inputs if fitness is not None else ()
    return [each for each in inputs if each.measure is not None]


def inputs_of(fitness: Fitness | None) -> list[FitnessInput]:
    """Return the inputs of a fitness that have a value in a run, in order."""
    inputs = fitness.inputs if fitness is not None else ()
    return [each for each in inputs if each.measure is not None or each.space is not None]


def evaluate(
    fitness: Fitness, readings: Sequence[Reading], space: Space = ABSTRACT
) -> FitnessResult:
    """Return the fitness of a run with these values of its measures, and those of its space."""
    given = iter(readings)
    measures = tuple(
        Measured(
            each,
            next(given)
            if each.space is None
            else Reading(space.measure(each.space.quantity, each.space.of)),
        )
        for each in inputs_of(fitness)
    )
    data: dict[str, float | None] = {each.input.name: each.reading.value for each in measures}
    known = params_by_name(fitness.params)
    values = {each.name: _constant(each, known) for each in fitness.params}
    faults = (f"`{each.input.name}`: {each.fault}" for each in measures if each.fault)
    reason = next(chain(_missing(fitness, data, values), faults), "")
    if reason:
        return FitnessResult(fitness, measures, None, reason)
    try:
        value = float(function_of(fitness.value)({**values, **data}, None))
    except (ArithmeticError, ValueError, ExecutionError) as error:
        return FitnessResult(fitness, measures, None, str(error))
    if not math.isfinite(value):
        return FitnessResult(fitness, measures, None, "it is not finite")
    return FitnessResult(fitness, measures, value)


def _constant(param: Param, known: Mapping[str, Param]) -> Value | None:
    """Return the value of a param, times in nanoseconds; None if it has none."""
    value = constant(param.default, known) if param.default is not None else None
    if isinstance(value, (int, float)) and param.type == DURATION:
        return round(value * SECOND)
    return value


def _missing(
    fitness: Fitness, data: Mapping[str, object], params: Mapping[str, object]
) -> Iterator[str]:
    """Yield the reasons why a fitness cannot be computed."""
    for each in fitness.inputs:
        if each.name not in data:
            yield f"`{each.name}` is not measured"
        elif data[each.name] is None and each.space is not None:
            yield f"`{each.name}` has no value, because robots have no places here"
        elif data[each.name] is None:
            yield f"`{each.name}` has no value, because there is no robot"
    for name, value in params.items():
        if value is None:
            yield f"param `{name}` has no value"


def measure_rows(result: FitnessResult) -> Iterator[tuple[str, str, str]]:
    """Yield the measures and the fitness with their values."""
    for each in result.measures:
        missed = "" if each.reading.reached else "not reached"
        note = each.fault or missed
        yield each.input.name, value_text(each.reading.value, is_time=each.is_time), note
    goal = f"fitness, to {result.fitness.goal}"
    missed = f"with {', '.join(result.unreached)} not reached" if result.unreached else ""
    reason = result.reason or missed
    note = f"{goal}: {reason}" if reason else goal
    yield result.fitness.name, value_text(result.value, is_time=False), note


def value_text(value: float | None, *, is_time: bool) -> str:
    """Format a number, or a time in nanoseconds."""
    if value is None:
        return "-"
    return format_duration(round(value)) if is_time else f"{value:.6g}"
