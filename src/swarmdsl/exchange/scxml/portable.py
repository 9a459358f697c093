"""The portable profile: a state machine as W3C SCXML that any engine can run.

Events that the machine itself makes begin with a keyword of the language, so they differ
from every event of the model:

    do.<state>.<outcome>     the activity of a state ended; its data are the result
    gives.<state>.succeeded  the same, once the result is stored
    after.<state>.<n>        the n-th delay of a state has passed
    final.<final state>      a final state was entered; comes before done.state.<state>
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from lxml import etree

from swarmdsl.exchange.scxml.ecmascript import dialect, first_value
from swarmdsl.exchange.scxml.ids import data_ids, state_ids
from swarmdsl.exchange.scxml.payload import describe_machine, describe_state
from swarmdsl.exchange.scxml.xml import PAYLOAD, SCXML, add, root
from swarmdsl.ir import (
    Assignment,
    DoneTrigger,
    Effect,
    EventTrigger,
    Expression,
    Literal,
    OutcomeTrigger,
    Send,
    State,
    StateKind,
    StateMachine,
    System,
    TimeTrigger,
    Transition,
    Trigger,
)
from swarmdsl.translate import Dialect, translate

# The type of a <send> that leaves the machine: it is the business of the host.
SEND_TYPE = "urn:swarmdsl:swarm"

_TAGS = {StateKind.PARALLEL: "parallel", StateKind.FINAL: "final"}


def portable(machine: StateMachine, system: System) -> etree._Element:
    """The document of a machine."""
    data = data_ids(machine)
    ids = state_ids(machine, set(data.values()))
    document = root(
        {None: SCXML, "sw": PAYLOAD},
        name=machine.name,
        version="1.0",
        datamodel="ecmascript" if _needs_data(machine) else "null",
        initial=ids[machine.initial],
    )
    describe_machine(document, machine, system, data)
    _add_data(document, machine, system, data)
    writer = _StateWriter(machine, ids, dialect(data), _told_apart(machine))
    for state in machine.states:
        writer.add_state(document, state)
    return document


def _add_data(
    document: etree._Element, machine: StateMachine, system: System, data: Mapping[str, str]
) -> None:
    if not data:
        return
    model = add(document, "datamodel")
    values = dialect(data)
    for param in machine.params:
        given = translate(param.default, values) if param.default is not None else None
        add(model, "data", id=data[param.name], expr=given)
    for variable in machine.variables:
        if variable.initial is not None:
            first = translate(variable.initial, values)
        else:
            first = first_value(variable.type, system)
        add(model, "data", id=data[variable.name], expr=first)


def _needs_data(machine: StateMachine) -> bool:
    """Whether the machine is more than SCXML's null data model can say."""
    if machine.variables or machine.params:
        return True
    return any(
        transition.guard is not None
        or any(isinstance(effect, Assignment) or effect.arguments for effect in transition.effects)
        for state in machine.walk()
        for transition in state.transitions
    )


def _told_apart(machine: StateMachine) -> frozenset[str]:
    """States of which some transition wants to know in which final state they are."""
    return frozenset(
        trigger.state
        for state in machine.walk()
        for transition in state.transitions
        for trigger in transition.triggers
        if isinstance(trigger, DoneTrigger) and trigger.final is not None
    )


@dataclass(frozen=True)
class _StateWriter:
    machine: StateMachine
    ids: Mapping[str, str]
    dialect: Dialect
    told_apart: frozenset[str]

    def add_state(self, parent: etree._Element, state: State, raises: bool = False) -> None:
        """Add a state and what is in it; a final state that `raises` says which one it is."""
        element = add(
            parent,
            _TAGS.get(state.kind, "state"),
            id=self.ids[state.id],
            initial=self.ids[state.initial] if state.initial is not None else None,
        )
        describe_state(element, state, self.machine, self.dialect)
        if raises:
            add(add(element, "onentry"), "raise", event=f"final.{self.ids[state.id]}")
        self._add_timers(element, state)
        self._add_transitions(element, state)
        for child in state.states:
            is_final = child.kind is StateKind.FINAL
            self.add_state(element, child, is_final and state.id in self.told_apart)

    def _add_timers(self, element: etree._Element, state: State) -> None:
        delays = _delays(state)
        if not delays:
            return
        entry = add(element, "onentry")
        leave = add(element, "onexit")
        for delay in delays:
            event = self._event(TimeTrigger(delay), state)
            given = {"delayexpr": f'Math.ceil({translate(delay, self.dialect)}) + "ms"'}
            if isinstance(delay, Literal):
                # Some engines take whole numbers only; none may fire too early.
                given = {"delay": f"{math.ceil(delay.milliseconds)}ms"}
            add(entry, "send", event=event, id=event, **given)
            add(leave, "cancel", sendid=event)

    def _add_transitions(self, element: etree._Element, state: State) -> None:
        end = OutcomeTrigger(state.id, "succeeded")
        results = state.activity is not None and state.activity.results
        taken = [each for each in state.transitions if end in each.triggers]
        # A guard must see the result already; other triggers of a transition bring none.
        first = any(each.guard is not None or len(each.triggers) > 1 for each in taken)
        stored = f"gives.{self.ids[state.id]}.succeeded"
        if results and (first or not taken):
            storing = add(element, "transition", event=self._event(end, state))
            add(storing, "raise", event=stored)
            self._add_results(storing, state)
        for transition in state.transitions:
            events = [
                stored if results and first and trigger == end else self._event(trigger, state)
                for trigger in transition.triggers
            ]
            added = self._add_transition(element, transition, events)
            if results and not first and end in transition.triggers:
                self._add_results(added, state)
            for effect in transition.effects:
                self._add_effect(added, effect)

    def _add_transition(
        self, element: etree._Element, transition: Transition, events: list[str]
    ) -> etree._Element:
        guard = transition.guard
        return add(
            element,
            "transition",
            event=" ".join(dict.fromkeys(events)) or None,
            cond=translate(guard, self.dialect) if guard is not None else None,
            type="internal" if transition.internal else None,
            target=self.ids[transition.target] if transition.target is not None else None,
        )

    def _add_results(self, element: etree._Element, state: State) -> None:
        assert state.activity is not None
        for mapping in state.activity.results:
            location = self._location(mapping.variable, mapping.path)
            add(element, "assign", location=location, expr=f"{self.dialect.event}.{mapping.field}")

    def _add_effect(self, element: etree._Element, effect: Effect) -> None:
        match effect:
            case Assignment(variable=variable, path=path, value=value):
                location = self._location(variable, path)
                add(element, "assign", location=location, expr=translate(value, self.dialect))
            case Send(event=event, arguments=arguments):
                sending = add(element, "send", event=event, type=SEND_TYPE)
                for name, value in arguments:
                    add(sending, "param", name=name, expr=translate(value, self.dialect))

    def _location(self, variable: str, path: tuple[str, ...]) -> str:
        return ".".join((self.dialect.variable(variable), *path))

    def _event(self, trigger: Trigger, state: State) -> str:
        """The event, or the events, that a trigger of this state means."""
        match trigger:
            case EventTrigger(event=event):
                return event
            case OutcomeTrigger(state=owner, outcome=outcome):
                return f"do.{self.ids[owner]}.{outcome}"
            case TimeTrigger(delay=delay):
                return f"after.{self.ids[state.id]}.{_delays(state).index(delay) + 1}"
            case DoneTrigger(state=owner, final=final):
                if final is not None:
                    return f"final.{self.ids[final]}"
                return self._done(owner)

    def _done(self, owner: str) -> str:
        if owner not in self.told_apart:
            return f"done.state.{self.ids[owner]}"
        # `done.state` would come second, when what the first event led to is over already.
        completed = next(each for each in self.machine.walk() if each.id == owner)
        finals = [each.id for each in completed.states if each.kind is StateKind.FINAL]
        return " ".join(f"final.{self.ids[final]}" for final in finals)


def _delays(state: State) -> list[Expression]:
    """The different delays of a state: transitions after the same time share a timer."""
    return list(
        dict.fromkeys(
            trigger.delay
            for transition in state.transitions
            for trigger in transition.triggers
            if isinstance(trigger, TimeTrigger)
        )
    )
