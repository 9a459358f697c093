"""Convert state machines of a model to tables of the engine.

The event names are those of portable SCXML; state ids are as in the model. `origin` is the IR node
of a state, transition or activity.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from operator import attrgetter
from typing import Any

from swarmdsl import ir
from swarmdsl.codegen.shared.default_values import default_value, field_type, sent_types
from swarmdsl.codegen.shared.events import Events, delays
from swarmdsl.codegen.shared.parallel_transitions import entered_region, region_transitions
from swarmdsl.codegen.shared.state_expressions import timed_states
from swarmdsl.execution.engine import (
    Activity,
    Effect,
    Envelope,
    Event,
    ExecutionError,
    Guard,
    InstanceLike,
    Kind,
    Machine,
    State,
    Transition,
    bounded,
)
from swarmdsl.execution.simulate.machines.copying import copied
from swarmdsl.execution.simulate.machines.expressions import (
    ACTIVE,
    ELAPSED,
    Value,
    function_of,
)
from swarmdsl.execution.simulate.machines.machine_data import first_data, store, stored
from swarmdsl.ir import (
    Assignment,
    Cancel,
    Elapsed,
    Expression,
    InState,
    Send,
    StateKind,
    System,
    Type,
    subexpressions,
)
from swarmdsl.ir.integer_ranges import bound_of_any

_KINDS = {StateKind.PARALLEL: Kind.PARALLEL, StateKind.FINAL: Kind.FINAL}
OUTCOMES = ("succeeded", "aborted", "preempted")


def table(machine: ir.StateMachine, system: System) -> Machine:
    """Convert a machine; instance data are a dictionary by name.

    Instances with their own param values get their data from `first_data`.
    """
    maker = TableMaker(machine, system)
    return Machine(
        machine.name,
        [maker.state(state) for state in machine.states],
        (machine.initial,),
        data=lambda: first_data(machine, system, {}),
    )


class TableMaker:
    """Converter of the states of a machine.

    Guards, effects and goals become callables by methods of their own, so that another converter
    can write the same table in another way.
    """

    def __init__(self, machine: ir.StateMachine, system: System) -> None:
        self.system = system
        self.timed = timed_states(machine)
        self.types = {variable.name: variable.type for variable in machine.variables}
        self.events = Events(machine, {state.id: state.id for state in machine.walk()})

    def state(self, state: ir.State, around: ir.State | None = None) -> State:
        """Convert a state and its content."""
        if state.kind is StateKind.HISTORY:
            default = Transition(targets=_targets(state.transitions[0]))
            kind = Kind.DEEP_HISTORY if state.deep else Kind.HISTORY
            return State(state.id, kind, transitions=(default,), origin=state)
        entry: list[Effect] = []
        leave: list[Effect] = []
        final = state.kind is StateKind.FINAL
        if final and around is not None and around.id in self.events.by_final_state:
            entry.append(self.raising(self.events.final(state.id)))
        if state.entry:
            entry.append(self.effects(state.entry))
        if delays(state):
            names = {self.events.timer(state, delay): delay for delay in delays(state)}
            entry.append(self.starting(names))
            leave.append(self.stopping(tuple(names)))
        if state.exit:
            leave.append(self.effects(state.exit))
        transitions = [self.transition(each, state) for each in state.transitions]
        if around is not None and around.kind is StateKind.PARALLEL:
            transitions += self.inward(state, around)
        return State(
            state.id,
            _KINDS.get(state.kind, Kind.STATE),
            tuple(self.state(child, state) for child in state.states),
            (state.initial,) if state.initial is not None else (),
            tuple(transitions),
            tuple(entry),
            tuple(leave),
            self.activity(state, state.activity) if state.activity is not None else None,
            origin=state,
            deferred=tuple(e for t in state.deferred for e in self.events.of_trigger(t, state)),
            timed=state.id in self.timed,
        )

    def transition(self, transition: ir.Transition, state: ir.State) -> Transition:
        """Convert a transition."""
        events = (e for t in transition.triggers for e in self.events.of_trigger(t, state))
        there = entered_region(transition, state) is not None
        return Transition(
            tuple(dict.fromkeys(events)),
            () if there else _targets(transition),
            self.guard(transition.guard),
            self.effects(transition.effects) if transition.effects and not there else None,
            transition.internal and not there,
            origin=transition,
        )

    def inward(self, region: ir.State, around: ir.State) -> Iterable[Transition]:
        """Return the transitions of a parallel state that this region executes."""
        for event, guard, transition, number in region_transitions(region, around, self.events):
            yield Transition(
                (event,) if event else (),
                _targets(transition),
                self.guard(guard),
                self.effects(transition.effects) if transition.effects else None,
                internal=True,
                origin=transition,
                around=number,
            )

    def activity(self, state: ir.State, activity: ir.Activity) -> Activity:
        """Convert an activity; parts that callbacks fill in are omitted."""
        call = self.system.function(activity.function).communication
        return Activity(
            activity.function,
            call.name,
            {outcome: self.events.outcome(state, outcome) for outcome in OUTCOMES},
            self.goal(activity),
            self.results(activity.results) if activity.results else None,
            "succeeded" if activity.judges_response else "aborted",
        )

    def goal(self, activity: ir.Activity) -> Callable[[InstanceLike], Any]:
        """Return the function that makes the goal of an activity."""
        sent = self.sent_types(activity)
        goal = [
            (name, stored(value, sent.get(name), self.system)) for name, value in activity.arguments
        ]
        view = _view(value for _, value in activity.arguments)

        def make_goal(instance: InstanceLike) -> dict[str, Any]:
            data = view(instance)
            return {name: value(data, None) for name, value in goal}

        return make_goal

    def sent_types(self, activity: ir.Activity) -> dict[str, Type]:
        """Return the types of the fields of the goal or request of an activity."""
        call = self.system.function(activity.function).communication
        return sent_types(self.system.interface(call.type))

    def results(self, results: Iterable[ir.ResultMapping]) -> Effect:
        """Return the effect that stores the results of an activity."""
        return _store_results([(each, self.bound(each)) for each in results])

    def bound(self, result: ir.ResultMapping) -> str | None:
        """Return the integer type whose range a stored result may exceed, or None."""
        return bound_of_any(self.held(result))

    def held(self, stored: ir.ResultMapping | Assignment) -> Type | None:
        """Return the type of what is stored in a variable or in a field of one."""
        return field_type(self.types.get(stored.variable), stored.path, self.system)

    def guard(self, expression: Expression | None) -> Guard | None:
        """Convert a guard."""
        return _guard(expression)

    def raising(self, name: str) -> Effect:
        """Return the effect that raises an event of the machine itself."""
        return _raise(name)

    def starting(self, timers: Mapping[str, Expression]) -> Effect:
        """Return the effect that starts the delays of a state, by the names of their events."""
        return _start_timers(timers)

    def stopping(self, names: Iterable[str]) -> Effect:
        """Return the effect that cancels the delays of a state."""
        return _cancel_timers(names)

    def effects(self, effects: Iterable[ir.Effect]) -> Effect:
        """Return the effects as one, which stops at the first error."""
        made = [self.effect(each) for each in effects]
        if len(made) == 1:
            return made[0]

        def all_of_them(instance: InstanceLike, event: Event) -> None:
            for each in made:
                each(instance, event)

        return all_of_them

    def effect(self, effect: ir.Effect) -> Effect:
        """Convert an effect."""
        match effect:
            case Assignment(variable=variable, path=path, value=expression):
                value = stored(expression, self.held(effect), self.system)
                view = _view([expression])

                def assign(instance: InstanceLike, event: Event) -> None:
                    store(instance.data, variable, path, value(view(instance), event))

                return assign
            case Cancel(event=name):
                return lambda instance, event: instance.cancel(f"send.{name}")
            case Send(event=name, arguments=arguments, to=to, delay=delay):
                type_ = self.system.event(name).type
                fields = [
                    (field, stored(value, field_type(type_, (field,), self.system), self.system))
                    for field, value in arguments
                ]

                address = _address(to) if to is not None else None
                wait = function_of(delay) if delay is not None else None
                used = [value for _, value in arguments]
                used += [*(to.values if to is not None else ()), *([delay] if delay else ())]
                view = _view(used)

                def send(instance: InstanceLike, event: Event) -> None:
                    data = view(instance)
                    message = default_value(type_, self.system)
                    for field, value in fields:
                        message[field] = value(data, event)
                    receiver = address(data, event) if address is not None else None
                    made = Event(name, message, envelope=Envelope(to=receiver))
                    if wait is None:
                        instance.emit(made)
                    else:
                        instance.emit_after(made, math.ceil(wait(data, event)))

                return send


def _targets(transition: ir.Transition) -> tuple[str, ...]:
    return (transition.target,) if transition.target is not None else ()


def _address(address: ir.Address) -> Value:
    """Compile an address; its value is the id of a robot, or a role."""
    if address.id is not None:
        return function_of(address.id)
    role = address.role
    if address.index is None:
        return lambda data, event: role
    index = function_of(address.index)
    return lambda data, event: f"{role}[{index(data, event)}]"


def _guard(expression: Expression | None) -> Guard | None:
    if expression is None:
        return None
    value, view = function_of(expression), _view([expression])
    return lambda instance, event: value(view(instance), event)


def _view(expressions: Iterable[Expression]) -> Callable[[InstanceLike], Mapping[str, Any]]:
    """Return the function that gives expressions the data of an instance.

    Expressions about states also get what tests and measures them.
    """
    parts = (part for each in expressions for part in subexpressions(each))
    if any(isinstance(part, (InState, Elapsed)) for part in parts):
        return lambda instance: {
            **instance.data,
            ACTIVE: instance.active,
            ELAPSED: instance.elapsed,
        }
    return attrgetter("data")


def _store_results(results: Iterable[tuple[ir.ResultMapping, str | None]]) -> Effect:
    def store_all(instance: InstanceLike, event: Event) -> None:
        for result, bound in results:
            try:
                value = event.data[result.field]
            except (KeyError, TypeError):
                raise ExecutionError(
                    f"there is no field `{result.field}` in {event.data!r}"
                ) from None
            if bound is not None:
                bounded(value, bound)
            store(instance.data, result.variable, result.path, copied(value))

    return store_all


def _raise(name: str) -> Effect:
    return lambda instance, event: instance.raise_event(Event(name))


def _start_timers(timers: Mapping[str, Expression]) -> Effect:
    lengths = [(name, function_of(delay)) for name, delay in timers.items()]
    view = _view(timers.values())

    def start(instance: InstanceLike, event: Event) -> None:
        data = view(instance)
        for name, length in lengths:
            instance.send_after(Event(name), math.ceil(length(data, None)), name)

    return start


def _cancel_timers(names: Iterable[str]) -> Effect:
    def cancel(instance: InstanceLike, event: Event) -> None:
        for name in names:
            instance.cancel(name)

    return cancel
