"""Properties and measures of a model, watched in a run."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from swarmdsl import ir
from swarmdsl.execution import monitor
from swarmdsl.execution.engine import ExecutionError
from swarmdsl.execution.monitor import Verdict, Watch
from swarmdsl.execution.simulate.actors import Actor
from swarmdsl.execution.simulate.expressions import Value, function_of
from swarmdsl.execution.simulate.subject import Subject
from swarmdsl.execution.simulate.trace import Line

Data = Callable[[Actor], Mapping[str, Any]]


def watchable(subject: Subject) -> list[ir.Property]:
    """Return the properties that are about the subject of a run."""
    system = subject.system
    found = system.properties if system is not None and subject.document is None else ()
    return [each for each in found if each.subject == subject.name]


def watch(
    properties: Sequence[ir.Property],
    data: Data,
    *,
    measures: Sequence[ir.FitnessInput] = (),
    stops: bool = False,
    told: Callable[[monitor.Property, Verdict, int], None] | None = None,
) -> Watch:
    """Return the monitors of properties and gauges of measures in one run, a listener of it.

    With `stops`, a violation raises ViolatedError. `told` is called with each verdict so far.
    """
    return Watch(
        [_plain(each) for each in properties],
        conditions(data),
        measures=[_measure(each.name, each.measure) for each in measures if each.measure],
        stops=stops,
        told=told,
    )


def conditions(data: Data) -> Callable[[Any, Any], bool]:
    """Return the function that evaluates conditions for the machine of a line."""
    functions: dict[ir.Expression, Value] = {}

    def has(line: Line, condition: ir.Expression) -> bool:
        if condition not in functions:
            functions[condition] = function_of(condition)
        try:
            params, values = line.actor.params, data(line.actor)
            # The robot may have params that its machine does not have.
            return bool(functions[condition]({**params, **values} if params else values, None))
        except (ArithmeticError, ValueError, ExecutionError):
            return False

    return has


def _measure(name: str, measure: ir.Measure) -> monitor.Measure:
    claim = claim_of(measure.claim)
    if measure.counted_role is not None:
        assert isinstance(claim, monitor.Fact)
        claim = claim._replace(robots=monitor.Robots(measure.counted_role, "every"))
    return monitor.Measure(name, measure.kind, claim, measure.over, measure.aggregate, measure.each)


def _plain(property_: ir.Property) -> monitor.Property:
    scope, within = property_.scope, property_.within
    sentence = monitor.Sentence(
        property_.kind,
        scope.kind if scope is not None else None,
        None if within is None else int(function_of(within)({}, None)),
        property_.times,
    )
    return monitor.Property(
        property_.name,
        sentence,
        tuple(map(claim_of, property_.claims)),
        tuple(map(claim_of, scope.claims)) if scope is not None else (),
        property_.each,
        property_.chance,
        property_.origin,
    )


def claim_of(claim: ir.Claim) -> monitor.Claim:
    """Return a claim as plain data."""
    if isinstance(claim, ir.Junction):
        return monitor.Junction(claim.operator, tuple(map(claim_of, claim.claims)))
    if isinstance(claim, ir.Count):
        return monitor.Count(claim.role, claim.state, claim.comparison, claim.number)
    robots = _robots(claim.robots) if claim.robots is not None else None
    return monitor.Fact(claim.act, claim.name, robots, claim.guard)


def _robots(robots: ir.Robots) -> monitor.Robots:
    least, most = (0, None) if robots.number is None else (robots.number.lower, robots.number.upper)
    return monitor.Robots(
        robots.role, robots.quantifier, least, most, robots.index or 0, robots.other
    )
