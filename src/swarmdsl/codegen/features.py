"""Uses of constructs of state machines, by feature and place.

If a target cannot express one of them, its generator does not run.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.base.source import Span
from swarmdsl.codegen.api import Feature
from swarmdsl.ir import (
    Activity,
    Assignment,
    Binary,
    Call,
    Cancel,
    Construction,
    Effect,
    Elapsed,
    EnvelopeField,
    EventData,
    EventTrigger,
    Expression,
    FieldAccess,
    InState,
    Query,
    SelfField,
    Send,
    State,
    StateKind,
    StateMachine,
    System,
    TimeTrigger,
    Transition,
    Unary,
)

Use = tuple[Feature, Span | None]

WAYS_OUT = {
    Feature.NEIGHBORS: "let a sensor publish the number, and `monitor` its topic",
    Feature.PRESENT: "count `member_joined` and `member_lost` in a variable, or build it for ROS 2",
}
"""Ways to do without a feature that a target does not support."""

_KINDS = {
    StateKind.COMPOSITE: Feature.COMPOSITE,
    StateKind.PARALLEL: Feature.PARALLEL,
    StateKind.CHOICE: Feature.CHOICE,
    StateKind.HISTORY: Feature.HISTORY,
}


def used_features(system: System) -> Iterator[Use]:
    """Yield every use of a feature, in document order."""
    for machine in system.machines:
        yield from uses_in_machine(machine)


def unsupported(machines: Iterable[StateMachine], supports: frozenset[Feature]) -> Iterator[Use]:
    """Yield the uses that a target does not support, one for each cause."""
    for machine in machines:
        causes = _causes_of_entering(machine)
        for feature, place in uses_in_machine(machine):
            if feature in supports:
                continue
            if feature is Feature.INTO_STATE and place in causes and not causes[place] <= supports:
                continue
            yield feature, place


def _causes_of_entering(machine: StateMachine) -> dict[Span | None, set[Feature]]:
    """Map transitions into a state to the features that make them so."""
    histories = {state.id for state in machine.walk() if state.kind is StateKind.HISTORY}
    found: dict[Span | None, set[Feature]] = {}
    for state in machine.walk():
        for transition in state.transitions:
            causes = found.setdefault(transition.origin, set())
            if transition.internal:
                causes.add(Feature.INTERNAL)
            if state.id in histories or transition.target in histories:
                causes.add(Feature.HISTORY)
    # Transitions without an origin cannot be distinguished.
    found.pop(None, None)
    return found


def uses_in_machine(machine: StateMachine) -> Iterator[Use]:
    """Yield every use of a feature in a machine."""
    for param in machine.params:
        yield Feature.PARAM, param.origin
    for variable in machine.variables:
        yield Feature.VARIABLE, variable.origin
        if variable.initial is not None:
            yield from _uses_in_expression(variable.initial)
    # State id -> id of the enclosing state, None at the top.
    parents: dict[str, str | None] = {state.id: None for state in machine.states}
    for state in machine.walk():
        parents.update((child.id, state.id) for child in state.states)
    if parents[machine.initial] is not None:
        yield Feature.INTO_STATE, machine.origin
    for state in machine.walk():
        yield from _uses_in_state(state, parents)


def _uses_in_state(state: State, parents: dict[str, str | None]) -> Iterator[Use]:
    if state.kind in _KINDS:
        yield _KINDS[state.kind], state.origin
    if state.initial is not None and parents[state.initial] != state.id:
        yield Feature.INTO_STATE, state.origin
    if state.activity is not None:
        yield from _uses_in_activity(state.activity)
    for deferred in state.deferred:
        yield Feature.DEFER, deferred.origin
        if deferred.predefined:
            yield Feature.MEMBER_EVENT, deferred.origin
    for feature, effects in ((Feature.ENTRY, state.entry), (Feature.EXIT, state.exit)):
        for effect in effects:
            yield feature, effect.origin
            yield from _uses_in_effect(effect)
    for transition in state.transitions:
        yield from _uses_in_transition(transition)
        if not transition.triggers and state.kind not in (StateKind.CHOICE, StateKind.HISTORY):
            yield Feature.EVENTLESS, transition.origin
        if transition.target is not None:
            here, there = _ancestors(state.id, parents), _ancestors(transition.target, parents)
            if here[0] not in there:
                yield Feature.CROSS_LEVEL, transition.origin
            if there[0] not in here:
                yield Feature.INTO_STATE, transition.origin


def _ancestors(state: str, parents: dict[str, str | None]) -> list[str | None]:
    """Return the ids of the enclosing states, innermost first, then None."""
    found: list[str | None] = [parents[state]]
    while found[-1] is not None:
        found.append(parents[found[-1]])
    return found


def _uses_in_activity(activity: Activity) -> Iterator[Use]:
    if activity.goal_callback is not None or activity.result_callback is not None:
        yield Feature.CALLBACK, activity.origin
    for _, value in activity.arguments:
        yield from _uses_in_expression(value)
    for result in activity.results:
        yield Feature.RESULT, result.origin


def _uses_in_transition(transition: Transition) -> Iterator[Use]:
    if transition.internal:
        yield Feature.INTERNAL, transition.origin
    if transition.target is None:
        yield Feature.TARGETLESS, transition.origin
    for trigger in transition.triggers:
        if isinstance(trigger, TimeTrigger):
            yield Feature.TIMEOUT, trigger.origin
            yield from _uses_in_expression(trigger.delay)
        elif isinstance(trigger, EventTrigger) and trigger.predefined:
            yield Feature.MEMBER_EVENT, trigger.origin
    if transition.guard is not None:
        yield Feature.GUARD, transition.guard.origin
        yield from _uses_in_expression(transition.guard)
    for effect in transition.effects:
        yield from _uses_in_effect(effect)


def _uses_in_effect(effect: Effect) -> Iterator[Use]:
    match effect:
        case Assignment(value=value):
            yield Feature.ASSIGNMENT, effect.origin
            yield from _uses_in_expression(value)
        case Cancel():
            yield Feature.DELAYED_SEND, effect.origin
        case Send(arguments=arguments, to=to, delay=delay):
            yield Feature.SEND, effect.origin
            if delay is not None:
                yield Feature.DELAYED_SEND, delay.origin or effect.origin
                yield from _uses_in_expression(delay)
            for _, value in arguments:
                yield from _uses_in_expression(value)
            if to is not None:
                yield Feature.ADDRESS, to.origin
                for value in to.values:
                    yield from _uses_in_expression(value)


def _uses_in_expression(expression: Expression) -> Iterator[Use]:
    match expression:
        case EventData():
            yield Feature.EVENT_DATA, expression.origin
        case EnvelopeField():
            yield Feature.SENDER, expression.origin
        case InState():
            yield Feature.IN_STATE, expression.origin
        case Elapsed():
            yield Feature.ELAPSED, expression.origin
        case SelfField():
            yield Feature.SELF, expression.origin
        case FieldAccess(base=base):
            yield from _uses_in_expression(base)
        case Unary(operand=operand):
            yield from _uses_in_expression(operand)
        case Binary(left=left, right=right):
            yield from _uses_in_expression(left)
            yield from _uses_in_expression(right)
        case Call(function="present"):
            yield Feature.PRESENT, expression.origin
        case Call(function="neighbors", arguments=(distance,)):
            yield Feature.NEIGHBORS, expression.origin
            yield from _uses_in_expression(distance)
        case Call(arguments=arguments):
            for argument in arguments:
                yield from _uses_in_expression(argument)
        case Query(array=array, condition=condition, key=key):
            for part in (array, condition, key):
                if part is not None:
                    yield from _uses_in_expression(part)
        case Construction(values=values):
            for _, value in values:
                yield from _uses_in_expression(value)
