"""Values that a run measures: the fitness, its inputs, and properties."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.suggest import suggest
from swarmdsl.execution.estimation.intervals import clopper_pearson
from swarmdsl.execution.estimation.sample import Sample, summarize
from swarmdsl.execution.experiments.task import Row
from swarmdsl.execution.monitor import TRUE
from swarmdsl.execution.simulate.evaluation.measures import fitness_of, inputs_of
from swarmdsl.execution.simulate.evaluation.properties import watchable
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.ir import Fitness

FITNESS = "fitness"
"""Name of the fitness of the swarm as what is measured."""
PROPERTY = "property"
"""Kind of a measure: 1 in a run in which it is true, else 0."""


def measures(subject: Subject) -> dict[str, str]:
    """Return what can be measured of a subject, each with its kind."""
    fitness = fitness_of(subject)
    found = {each.name: PROPERTY for each in watchable(subject)}
    if fitness is not None:
        found |= {each.name: "measure" for each in inputs_of(fitness)}
        found[FITNESS] = "fitness"
    return found


def measured_fitness(subject: Subject, report: Diagnostics) -> Fitness | None:
    """Return the fitness of a swarm; report if no run measures one."""
    found = fitness_of(subject)
    if found is None:
        help_ = "give its inputs measures, as in `in done : uint32 = total(robot in Done)`"
        reason = "no fitness that a run measures"
        report.report("nothing-to-optimize", name=subject.name, reason=reason, help=help_)
    return found


def check_properties(names: Sequence[str], subject: Subject, report: Diagnostics) -> None:
    """Report names of properties that a run cannot keep."""
    assert subject.system is not None
    about = [each for each in subject.system.judged if each.subject == subject.name]
    known = [each.name for each in about if each.chance is None]
    for name in names:
        if name not in known:
            has_chance = any(each.name == name for each in about)
            help_ = f"`{name}` has a chance: it is about many" if has_chance else None
            help_ = help_ or suggest(name, known, "properties")
            report.report("unresolved-name", kind="property of one run", name=name, help=help_)


def value_of(row: Row, measure: str) -> float | None:
    """Return the value of a run: the fitness, a measure, or 1 if a property is true, else 0."""
    if measure == FITNESS:
        return row.fitness
    if measure in row.measures:
        return row.measures[measure]
    if measure in row.verdicts:
        return float(row.verdicts[measure] == TRUE)
    return None


def summary_of(values: Sequence[float], level: float, *, is_property: bool) -> Sample | None:
    """Return the summary of values; that of a property has the interval of a probability.

    Equal values of a property do not show that it is never different, as Student would have it.
    """
    found = summarize(values, level)
    if found is None or not is_property or not set(values) <= {0.0, 1.0}:
        return found
    return replace(found, interval=clopper_pearson(round(sum(values)), len(values), level))
