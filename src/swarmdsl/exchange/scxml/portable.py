"""The portable profile: a state machine as W3C SCXML that any engine can run.

The effects of entering a state come before its delays start and its activity does: both may
use what the effects store. Each group is an element of its own, because an effect that fails
keeps those after it in the same element from being done.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from swarmdsl.exchange.scxml.ecmascript import dialect, first_value, needs_data, stored
from swarmdsl.exchange.scxml.events import Events, delays
from swarmdsl.exchange.scxml.ids import data_ids, state_ids
from swarmdsl.exchange.scxml.inward import inward, region_entered
from swarmdsl.exchange.scxml.payload import describe_machine, describe_state
from swarmdsl.exchange.scxml.xml import NAMESPACES
from swarmdsl.ir import (
    Assignment,
    Effect,
    Expression,
    Literal,
    OutcomeTrigger,
    Send,
    State,
    StateKind,
    StateMachine,
    System,
    doc_of,
)
from swarmdsl.translate import Dialect, translate
from swarmdsl.xml import Element

# The type of a <send> that leaves the machine: it is the business of the host.
SEND_TYPE = "urn:swarmdsl:swarm"

_TAGS = {
    StateKind.PARALLEL: "parallel",
    StateKind.FINAL: "final",
    StateKind.HISTORY: "history",
}


def portable(machine: StateMachine, system: System) -> Element:
    """The document of a machine."""
    data = data_ids(machine)
    ids = state_ids(machine, set(data.values()))
    document = Element(
        "scxml",
        NAMESPACES,
        name=machine.name,
        version="1.0",
        datamodel="ecmascript" if needs_data(machine) else "null",
        initial=ids[machine.initial],
    )
    describe_machine(document, machine, system, data)
    _add_data(document, machine, system, data)
    writer = _StateWriter(machine, ids, dialect(data), Events(machine, ids))
    for state in machine.states:
        writer.add_state(document, state)
    return document


def _add_data(
    document: Element, machine: StateMachine, system: System, data: Mapping[str, str]
) -> None:
    if not data:
        return
    model = document.add("datamodel")
    values = dialect(data)
    for param in machine.params:
        given = translate(param.default, values) if param.default is not None else None
        model.add("data", id=data[param.name], expr=given).origin = param.origin
    for variable in machine.variables:
        if variable.initial is not None:
            first = translate(variable.initial, values)
        else:
            first = first_value(variable.type, system)
        model.add("data", id=data[variable.name], expr=first).origin = variable.origin


@dataclass(frozen=True)
class _StateWriter:
    machine: StateMachine
    ids: Mapping[str, str]
    dialect: Dialect
    events: Events

    def add_state(self, parent: Element, state: State, around: State | None = None) -> None:
        """Add a state and what is in it."""
        depth = ("deep" if state.deep else "shallow") if state.kind is StateKind.HISTORY else None
        element = parent.add(
            _TAGS.get(state.kind, "state"),
            id=self.ids[state.id],
            initial=self.ids[state.initial] if state.initial is not None else None,
            type=depth,
        )
        element.origin = state.origin
        describe_state(element, state, self.machine, self.dialect)
        if (
            state.kind is StateKind.FINAL
            and around is not None
            and around.id in self.events.told_apart
        ):
            element.add("onentry").add("raise", event=self.events.final(state.id))
        if state.entry:
            element.add_comment(doc_of(state.docs, "entry"))
            self._add_effects(element.add("onentry"), state.entry)
        self._add_timers(element, state)
        if state.exit:
            element.add_comment(doc_of(state.docs, "exit"))
            self._add_effects(element.add("onexit"), state.exit)
        self._add_transitions(element, state)
        if around is not None and around.kind is StateKind.PARALLEL:
            self._add_inward(element, state, around)
        for child in state.states:
            self.add_state(element, child, state)

    def _add_timers(self, element: Element, state: State) -> None:
        waiting = delays(state)
        if not waiting:
            return
        entry = element.add("onentry")
        leave = element.add("onexit")
        for delay in waiting:
            event = self.events.timer(state, delay)
            # A time that is over before it begins is over at once, as in the other targets.
            length = translate(delay, self.dialect)
            given = {"delayexpr": f'Math.max(0, Math.ceil({length})) + "ms"'}
            if isinstance(delay, Literal):
                # Some engines take whole numbers only; none may fire too early.
                given = {"delay": f"{math.ceil(delay.milliseconds)}ms"}
            entry.add("send", event=event, id=event, **given)
            leave.add("cancel", sendid=event)

    def _add_transitions(self, element: Element, state: State) -> None:
        end = OutcomeTrigger(state.id, "succeeded")
        results = state.activity is not None and state.activity.results
        taken = [each for each in state.transitions if end in each.triggers]
        # Guards and effects on exit must see the result; other triggers of a transition bring none.
        first = any(each.guard is not None or len(each.triggers) > 1 for each in taken)
        first = first or self._is_left_with_effects(state)
        done = self.events.stored(state)
        if results and (first or not taken):
            storing = element.add("transition", event=self.events.outcome(state, "succeeded"))
            storing.add("raise", event=done)
            self._add_results(storing, state)
        for transition in state.transitions:
            events = [
                done if results and first and trigger == end else event
                for trigger in transition.triggers
                for event in self.events.of_trigger(trigger, state)
            ]
            # No element: there, an engine would try to do what it does not know.
            element.add_comment(transition.doc)
            if region_entered(transition, state) is not None:
                # What it does stands in the region. Here it keeps those after it from being taken.
                kept = self._add_transition(element, events, transition.guard)
                kept.origin = transition.origin
                continue
            added = self._add_transition(
                element, events, transition.guard, transition.internal, transition.target
            )
            added.origin = transition.origin
            if results and not first and end in transition.triggers:
                self._add_results(added, state)
            self._add_effects(added, transition.effects)

    def _is_left_with_effects(self, state: State) -> bool:
        around = (each for each in self.machine.walk() if f"{state.id}.".startswith(f"{each.id}."))
        return any(each.exit for each in around)

    def _add_inward(self, element: Element, region: State, around: State) -> None:
        for event, guard, transition in inward(region, around, self.events):
            events = [event] if event else []
            added = self._add_transition(element, events, guard, True, transition.target)
            added.origin = transition.origin
            self._add_effects(added, transition.effects)

    def _add_transition(
        self,
        element: Element,
        events: list[str],
        guard: Expression | None,
        internal: bool = False,
        target: str | None = None,
    ) -> Element:
        return element.add(
            "transition",
            event=" ".join(dict.fromkeys(events)) or None,
            cond=translate(guard, self.dialect) if guard is not None else None,
            type="internal" if internal else None,
            target=self.ids[target] if target is not None else None,
        )

    def _add_results(self, element: Element, state: State) -> None:
        assert state.activity is not None
        for mapping in state.activity.results:
            location = self._location(mapping.variable, mapping.path)
            # Not copied: a result is in nobody else's hands.
            element.add("assign", location=location, expr=f"{self.dialect.event}.{mapping.field}")

    def _add_effects(self, element: Element, effects: Iterable[Effect]) -> None:
        for effect in effects:
            match effect:
                case Assignment(variable=variable, path=path, value=value):
                    location = self._location(variable, path)
                    element.add("assign", location=location, expr=stored(value, self.dialect))
                case Send(event=event, arguments=arguments):
                    sending = element.add("send", event=event, type=SEND_TYPE)
                    for name, value in arguments:
                        sending.add("param", name=name, expr=stored(value, self.dialect))

    def _location(self, variable: str, path: tuple[str, ...]) -> str:
        return ".".join((self.dialect.variable(variable), *path))
