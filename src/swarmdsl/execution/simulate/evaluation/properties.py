"""Properties and measures of a model, watched in a run."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from swarmdsl import ir
from swarmdsl.execution import monitor
from swarmdsl.execution.engine import Event, ExecutionError
from swarmdsl.execution.monitor import Verdict, Watch
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.expressions import Value, function_of
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.world.line import Line

Data = Callable[[Actor], Mapping[str, Any]]


def watchable(subject: Subject) -> list[ir.Property]:
    """Return the properties that are about the subject of a run."""
    system = subject.system
    found = system.judged if system is not None and subject.document is None else ()
    return [each for each in found if each.subject == subject.name]


def plan(
    properties: Sequence[ir.Property], measures: Sequence[ir.FitnessInput] = ()
) -> monitor.Plan:
    """Return properties and measures, ready to be watched in any number of runs."""
    return monitor.Plan(
        [_plain(each) for each in properties],
        [_measure(each.name, each.measure) for each in measures if each.measure],
    )


def watch(
    planned: monitor.Plan,
    data: Data,
    *,
    stops: bool = False,
    told: Callable[[monitor.Property, Verdict, int], None] | None = None,
) -> Watch:
    """Return the monitors of properties and gauges of measures in one run, a listener of it.

    With `stops`, a violation raises ViolatedError. `told` is called with each verdict so far.
    """
    return Watch(planned, conditions(data), stops=stops, told=told)


def conditions(data: Data) -> Callable[[Any, Any], bool]:
    """Return the function that evaluates the conditions of facts for the machine of a line."""
    functions: dict[ir.Expression, tuple[Value, bool]] = {}

    def has(line: Line, fact: monitor.Fact) -> bool:
        condition: Any = fact.condition
        if condition not in functions:
            functions[condition] = function_of(condition), ir.reads_values(condition)
        holds, reads = functions[condition]
        actor = line.actor
        if reads and actor.name != actor.robot.name:
            return False  # the values are those of the robot, not of its part
        params, values = actor.params, data(actor)
        if params:
            values = {**params, **values}  # the robot may have some that its machine does not have
        return any(_is_true(holds, values, event) for event in _events(line, fact))

    return has


def _events(line: Line, fact: monitor.Fact) -> Iterator[Event | None]:
    """Yield the events of a line that a condition is about; None if it is about the robot."""
    if fact.act == "has":
        yield None
    elif fact.act == "sends":
        for name, message in zip(line.sent, line.messages, strict=True):
            if name == fact.name:
                yield Event(name, message)
    else:
        yield Event(line.event or "", line.data, envelope=line.envelope)


def _is_true(condition: Value, values: Mapping[str, Any], event: Event | None) -> bool:
    """Return the truth of a condition; one without a value does not hold."""
    try:
        return bool(condition(values, event))
    except (ArithmeticError, ValueError, ExecutionError):
        return False


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
    return monitor.Fact(claim.act, claim.name, robots, claim.guard, claim.outcome)


def _robots(robots: ir.Robots) -> monitor.Robots:
    least, most = (0, None) if robots.number is None else (robots.number.lower, robots.number.upper)
    return monitor.Robots(
        robots.role, robots.quantifier, least, most, robots.index or 0, robots.other
    )
