"""What a run measures: the fitness, its inputs, and properties."""

from __future__ import annotations

from swarmdsl.execution.experiments.task import Row
from swarmdsl.execution.monitor import TRUE
from swarmdsl.execution.simulate.measures import fitness_of, inputs_of
from swarmdsl.execution.simulate.properties import watchable
from swarmdsl.execution.simulate.subject import Subject

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


def value_of(row: Row, measure: str) -> float | None:
    """Return the value of a run: the fitness, a measure, or 1 if a property is true, else 0."""
    if measure == FITNESS:
        return row.fitness
    if measure in row.measures:
        return row.measures[measure]
    if measure in row.verdicts:
        return float(row.verdicts[measure] == TRUE)
    return None
