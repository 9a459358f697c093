"""Models in which some data are left open: conditions on them may hold or not, each time.

They do all that the real ones do, and more. So what holds in all their runs, holds.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence

from swarmdsl import ir
from swarmdsl.base.records import replace
from swarmdsl.codegen.shared.default_values import field_type, sent_types
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.expressions import ATTEMPT, ONE_OF
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.verify.abstraction.places import Node, behind, places_in
from swarmdsl.execution.verify.abstraction.slice import can_fail
from swarmdsl.execution.verify.swarm.machines import conditions, facts_by_role
from swarmdsl.syntax.types import BOOL, STRING, Type

_EITHER = ir.Call(ONE_OF, (ir.Literal(False, BOOL), ir.Literal(True, BOOL)), BOOL)
_ATTEMPT = ir.Call(ATTEMPT, (), BOOL)
_NOBODY = ""


class _NeededError(Exception):
    """Data decide on more than on conditions and addresses."""


def loosened(
    subject: Subject,
    machines: Iterable[ir.StateMachine],
    left_open: Collection[Node],
    receivers: Iterable[str] = (),
) -> Subject | None:
    """Return a subject whose machines read none of some data; None if delays depend on them.

    A condition on such a place goes either way, a message whose address is one is for any of
    the `receivers` or for nobody. An effect that stores or sends it is left out, but for whether it
    has a value.
    """
    assert subject.system is not None
    address = ir.Literal(_NOBODY, STRING), *(ir.Literal(each, STRING) for each in receivers)
    anybody = ir.Call(ONE_OF, address, STRING) if len(address) > 1 else address[0]
    try:
        changed = {
            each.name: _Machine(subject.system, each, left_open, ir.Address(id=anybody)).loosened()
            for each in machines
        }
    except _NeededError:
        return None
    made = tuple(changed.get(each.name, each) for each in subject.system.machines)
    machine = subject.machine
    return replace(
        subject,
        system=replace(subject.system, machines=made),
        machine=changed.get(machine.name) if machine is not None else None,
        tables={},
    )


def is_about(property_: ir.Property, cast: Sequence[Actor], data: Collection[Node]) -> bool:
    """Return True if a condition of a property reads some data of a robot."""
    return any(
        is_read(condition, machine, events, data)
        for machine, condition, events in conditions(cast, facts_by_role(cast, [property_]))
    )


def is_read(
    expression: ir.Expression, machine: str, events: tuple[str, ...], data: Collection[Node]
) -> bool:
    """Return True if an expression reads any of some data."""
    return any(
        behind(node, each, each) is not None
        for node in places_in(expression, machine, events)
        for each in data
    )


class _Machine:
    """State machine of which what reads open data is changed."""

    def __init__(
        self,
        system: ir.System,
        machine: ir.StateMachine,
        left_open: Collection[Node],
        anybody: ir.Address,
    ) -> None:
        self._system = system
        self._machine = machine
        self._open = left_open
        self._anybody = anybody
        self._types = {each.name: each.type for each in machine.variables}
        self._handled = tuple(
            dict.fromkeys(
                name
                for state in machine.walk()
                for transition in state.transitions
                for name in _events(transition)
            )
        )

    def loosened(self) -> ir.StateMachine:
        """Return the machine without what reads the data."""
        return replace(self._machine, states=tuple(map(self._state, self._machine.states)))

    def _state(self, state: ir.State) -> ir.State:
        return replace(
            state,
            states=tuple(map(self._state, state.states)),
            transitions=tuple(map(self._transition, state.transitions)),
            activity=self._activity(state.activity) if state.activity is not None else None,
            entry=self._effects(state.entry, self._handled),
            exit=self._effects(state.exit, self._handled),
        )

    def _transition(self, transition: ir.Transition) -> ir.Transition:
        events = _events(transition) or self._handled
        for trigger in transition.triggers:
            if isinstance(trigger, ir.TimeTrigger):
                self._require_known(trigger.delay, ())
        guard = transition.guard
        return replace(
            transition,
            guard=self._guard(guard, events) if guard is not None else None,
            effects=self._effects(transition.effects, events),
        )

    def _guard(self, guard: ir.Expression, events: tuple[str, ...]) -> ir.Expression:
        # One without a value does not hold, whatever its parts are.
        if self._is_open(guard, events) and can_fail(guard, None):
            return _EITHER
        return self._condition(guard, events)

    def _condition(self, expression: ir.Expression, events: tuple[str, ...]) -> ir.Expression:
        if not self._is_open(expression, events):
            return expression
        match expression:
            case ir.Unary(operator="not") | ir.Binary(operator="and" | "or"):
                return ir.mapped(expression, lambda part: self._condition(part, events))
        return _EITHER

    def _activity(self, activity: ir.Activity) -> ir.Activity:
        call = self._system.function(activity.function).communication
        types = sent_types(self._system.known_interface(call.type))
        arguments = [(name, value, types.get(name)) for name, value in activity.arguments]
        return replace(activity, arguments=tuple(self._arguments(arguments, self._handled)))

    def _effects(
        self, effects: Iterable[ir.Effect], events: tuple[str, ...]
    ) -> tuple[ir.Effect, ...]:
        made = [step for each in effects for step in self._effect(each, events)]
        while made and isinstance(made[-1], ir.Assignment) and made[-1].value is _ATTEMPT:
            # Nothing follows that a failure would leave out.
            made.pop()
        return tuple(made)

    def _effect(self, effect: ir.Effect, events: tuple[str, ...]) -> Iterator[ir.Effect]:
        match effect:
            case ir.Assignment(variable=variable, path=path, value=value):
                if not self._is_open(value, events):
                    yield effect
                elif can_fail(value, field_type(self._types.get(variable), path, self._system)):
                    yield ir.Assignment("", (), _ATTEMPT)
            case ir.Send(event=event, arguments=arguments, to=to, delay=delay):
                if delay is not None:
                    self._require_known(delay, events)
                if to is not None and any(self._is_open(each, events) for each in to.values):
                    if any(can_fail(each, None) for each in to.values):
                        yield ir.Assignment("", (), _ATTEMPT)
                    to = self._anybody
                type_ = self._system.event(event).type
                sent = [(f, value, field_type(type_, (f,), self._system)) for f, value in arguments]
                yield replace(effect, arguments=tuple(self._arguments(sent, events)), to=to)
            case _:
                yield effect

    def _arguments(
        self,
        arguments: Iterable[tuple[str, ir.Expression, Type | None]],
        events: tuple[str, ...],
    ) -> Iterator[tuple[str, ir.Expression]]:
        for field, value, held in arguments:
            if not self._is_open(value, events):
                yield field, value
            elif can_fail(value, held):
                yield field, _ATTEMPT

    def _require_known(self, expression: ir.Expression, events: tuple[str, ...]) -> None:
        if self._is_open(expression, events):
            raise _NeededError

    def _is_open(self, expression: ir.Expression, events: tuple[str, ...]) -> bool:
        return is_read(expression, self._machine.name, events, self._open)


def _events(transition: ir.Transition) -> tuple[str, ...]:
    return tuple(each.event for each in transition.triggers if isinstance(each, ir.EventTrigger))
