"""Checks of measures: their types, and facts that do not last."""

from __future__ import annotations

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.properties import check_facts
from swarmdsl.analysis.resolve.sentences import facts_in
from swarmdsl.analysis.types.space_types import LENGTH
from swarmdsl.base.diagnostics.advice import edits
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import Fitness, FitnessInput, FitnessUse, Measure, Swarm
from swarmdsl.syntax.types import DURATION, FLOAT, INT, Type, with_unit
from swarmdsl.syntax.units import UNITS

_IN_SPACE = {
    "distance": LENGTH,
    "energy": with_unit(FLOAT, UNITS["J"]),
    "covered": FLOAT,
    "found": INT,
}
"""Types of measures of a space."""


def check_measures(fitness: Fitness, context: Context) -> None:
    """Check the measures of a fitness."""
    for item in fitness.items:
        if isinstance(item, FitnessInput) and item.measure is not None:
            check_facts(item.measure, fitness, context)
            _check_lasting(item.measure, context)
            context.check_fits(_type(item.measure), item.type.type, item.measure.span)
        if isinstance(item, FitnessInput) and item.space is not None:
            context.check_fits(_IN_SPACE[item.space.quantity], item.type.type, item.space.span)


def check_measured_swarm(swarm: Swarm, context: Context) -> None:
    """Report a fitness of a swarm whose measures are about another one."""
    for item in swarm.items:
        fitness = item.fitness.target if isinstance(item, FitnessUse) else None
        if fitness is None or fitness.about in (None, swarm):
            continue
        assert fitness.about is not None
        at = fitness.subject.span if fitness.subject is not None else fitness.name.span
        context.report.report(
            "foreign-fitness",
            item.span,
            name=fitness.name,
            other=fitness.about.name,
            related=(Label(at, "its measures are about another swarm"),),
            help=f"declare a fitness `of {swarm.name}`, or measure nothing in this one",
        )


def _type(measure: Measure) -> Type:
    if measure.kind == "time":
        return DURATION
    return FLOAT if "mean" in (measure.aggregate, measure.over) else INT


def _totalled(measure: Measure) -> str:
    """Return the help for a measure of what only happens."""
    text = "count how often it happens with `total(...)`, or name a state with `in`"
    source, start, _ = measure.span
    if measure.kind != "count" or measure.over:
        return text
    at = source.text.index("count", start)
    return edits(text, "Write `total(...)`", (Span(source, at, at + len("count")), "total"))


def _check_lasting(measure: Measure, context: Context) -> None:
    """Report what only happens where the measure is about what is."""
    if measure.kind == "total" or measure.until:
        return
    for fact in facts_in(measure):
        if fact.event is not None or fact.function is not None:
            context.report.report(
                "momentary-fact",
                fact.span,
                kind=measure.kind,
                help=_totalled(measure),
            )
