"""The portable profile: a state machine as W3C SCXML that any engine can run.

Effects on entry come before delays start and the activity runs: both may use stored values.
Each group is an element of its own, because an effect that fails skips those after it in the
same element.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from itertools import accumulate

from lxml import etree

from swarmdsl.base.records import dataclass
from swarmdsl.codegen.exchange.scxml.delayed_sends import DelayedSends
from swarmdsl.codegen.exchange.scxml.ecmascript import (
    NOW,
    SELF,
    address,
    dialect,
    initial_value,
    needs_data,
    robot_alone,
    stored,
)
from swarmdsl.codegen.exchange.scxml.ids import data_ids, entry_ids, state_ids
from swarmdsl.codegen.exchange.scxml.payload import describe_machine, describe_state
from swarmdsl.codegen.exchange.scxml.xml import PAYLOAD, SCXML, add, root
from swarmdsl.codegen.shared.events import Events, delays
from swarmdsl.codegen.shared.identity import uses_self
from swarmdsl.codegen.shared.parallel_transitions import entered_region, region_transitions
from swarmdsl.codegen.shared.state_expressions import timed_states
from swarmdsl.codegen.xml_tree import Places, add_comment
from swarmdsl.ir import (
    Assignment,
    Cancel,
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
from swarmdsl.ir.expression_printer import Dialect, translate

# Type of a <send> that leaves the machine: the host handles it.
SEND_TYPE = "urn:swarmdsl:swarm"

_TAGS = {
    StateKind.PARALLEL: "parallel",
    StateKind.FINAL: "final",
    StateKind.HISTORY: "history",
}


def portable(machine: StateMachine, system: System, places: Places | None = None) -> etree._Element:
    """Return the document of a machine; `places` gets the origins of elements."""
    places = {} if places is None else places
    data = data_ids(machine)
    timed = timed_states(machine)
    timed_in_order = [state.id for state in machine.walk() if state.id in timed]
    entries = entry_ids(timed_in_order, (*data.values(), SELF))
    ids = state_ids(machine, {*data.values(), *entries.values(), SELF})
    document = root(
        {None: SCXML, "sw": PAYLOAD},
        name=machine.name,
        version="1.0",
        datamodel="ecmascript" if needs_data(machine) else "null",
        initial=ids[machine.initial],
    )
    describe_machine(document, machine, system, data)
    _add_data(document, machine, system, data, entries.values(), places)
    left_with_effects = frozenset(state.id for state in machine.walk() if state.exit)
    events = Events(machine, ids)
    words = dialect(data, system, ids, entries)
    writer = _StateWriter(
        machine, ids, entries, words, events, left_with_effects, places, DelayedSends()
    )
    for state in machine.states:
        writer.add_state(document, state)
    writer.delayed.finish()
    return document


def _add_data(
    document: etree._Element,
    machine: StateMachine,
    system: System,
    data: Mapping[str, str],
    entries: Iterable[str],
    places: Places,
) -> None:
    if not data and not uses_self(machine) and not entries:
        return
    model = add(document, "datamodel")
    values = dialect(data, system)
    if uses_self(machine):
        add(model, "data", id=SELF, expr=robot_alone())
    for param in machine.params:
        given = translate(param.default, values) if param.default is not None else None
        places[add(model, "data", id=data[param.name], expr=given)] = param.origin
    for variable in machine.variables:
        if variable.initial is not None:
            first = translate(variable.initial, values)
        else:
            first = initial_value(variable.type, system)
        places[add(model, "data", id=data[variable.name], expr=first)] = variable.origin
    for name in entries:
        add(model, "data", id=name, expr="0")


@dataclass(frozen=True)
class _StateWriter:
    machine: StateMachine
    ids: Mapping[str, str]
    entries: Mapping[str, str]
    dialect: Dialect
    events: Events
    left_with_effects: frozenset[str]
    places: Places
    delayed: DelayedSends

    def add_state(self, parent: etree._Element, state: State, around: State | None = None) -> None:
        """Add a state and what is in it."""
        depth = ("deep" if state.deep else "shallow") if state.kind is StateKind.HISTORY else None
        element = add(
            parent,
            _TAGS.get(state.kind, "state"),
            id=self.ids[state.id],
            initial=self.ids[state.initial] if state.initial is not None else None,
            type=depth,
        )
        self.places[element] = state.origin
        since = self.entries.get(state.id)
        describe_state(element, state, self.machine, self.dialect, since)
        if since is not None:
            add(add(element, "onentry"), "assign", location=since, expr=NOW)
        if (
            state.kind is StateKind.FINAL
            and around is not None
            and around.id in self.events.by_final_state
        ):
            add(add(element, "onentry"), "raise", event=self.events.final(state.id))
        if state.entry:
            add_comment(element, doc_of(state.docs, "entry"))
            self._add_effects(add(element, "onentry"), state.entry)
        self._add_timers(element, state)
        if state.exit:
            add_comment(element, doc_of(state.docs, "exit"))
            self._add_effects(add(element, "onexit"), state.exit)
        self._add_transitions(element, state)
        if around is not None and around.kind is StateKind.PARALLEL:
            self._add_inward(element, state, around)
        for child in state.states:
            self.add_state(element, child, state)

    def _add_timers(self, element: etree._Element, state: State) -> None:
        waiting = delays(state)
        if not waiting:
            return
        entry = add(element, "onentry")
        leave = add(element, "onexit")
        for delay in waiting:
            event = self.events.timer(state, delay)
            add(entry, "send", event=event, id=event, **self._delay(delay))
            add(leave, "cancel", sendid=event)

    def _delay(self, delay: Expression) -> dict[str, str]:
        """Return the attribute of a `<send>` with a delay."""
        if isinstance(delay, Literal):
            # Some engines accept integers only; round up, so that none fires too early.
            return {"delay": f"{math.ceil(delay.milliseconds)}ms"}
        # A negative delay is 0, as in the other targets.
        return {"delayexpr": f'Math.max(0, Math.ceil({translate(delay, self.dialect)})) + "ms"'}

    def _add_transitions(self, element: etree._Element, state: State) -> None:
        end = OutcomeTrigger(state.id, "succeeded")
        results = state.activity is not None and state.activity.results
        taken = [each for each in state.transitions if end in each.triggers]
        # Guards and effects on exit must see the result; other triggers have none.
        first = any(each.guard is not None or len(each.triggers) > 1 for each in taken)
        first = first or self._is_left_with_effects(state)
        done = self.events.stored(state)
        if results and (first or not taken):
            storing = add(element, "transition", event=self.events.outcome(state, "succeeded"))
            add(storing, "raise", event=done)
            self._add_results(storing, state)
        for transition in state.transitions:
            events = [
                done if results and first and trigger == end else event
                for trigger in transition.triggers
                for event in self.events.of_trigger(trigger, state)
            ]
            # Not an element: an engine would try to execute it.
            add_comment(element, transition.doc)
            if entered_region(transition, state) is not None:
                # Its effects are in the region. Here it keeps later transitions from being taken.
                kept = self._add_transition(element, events, transition.guard)
                self.places[kept] = transition.origin
                continue
            added = self._add_transition(
                element, events, transition.guard, transition.internal, transition.target
            )
            self.places[added] = transition.origin
            if results and not first and end in transition.triggers:
                self._add_results(added, state)
            self._add_effects(added, transition.effects)

    def _is_left_with_effects(self, state: State) -> bool:
        """Return True if the state or one around it has effects on exit."""
        around = accumulate(state.id.split("."), lambda outer, name: f"{outer}.{name}")
        return not self.left_with_effects.isdisjoint(around)

    def _add_inward(self, element: etree._Element, region: State, around: State) -> None:
        for event, guard, transition, _ in region_transitions(region, around, self.events):
            events = [event] if event else []
            added = self._add_transition(element, events, guard, True, transition.target)
            self.places[added] = transition.origin
            self._add_effects(added, transition.effects)

    def _add_transition(
        self,
        element: etree._Element,
        events: list[str],
        guard: Expression | None,
        internal: bool = False,
        target: str | None = None,
    ) -> etree._Element:
        return add(
            element,
            "transition",
            event=" ".join(dict.fromkeys(events)) or None,
            cond=translate(guard, self.dialect) if guard is not None else None,
            type="internal" if internal else None,
            target=self.ids[target] if target is not None else None,
        )

    def _add_results(self, element: etree._Element, state: State) -> None:
        assert state.activity is not None
        for mapping in state.activity.results:
            location = self._location(mapping.variable, mapping.path)
            # Not copied: nothing else refers to a result.
            add(element, "assign", location=location, expr=f"{self.dialect.event}.{mapping.field}")

    def _add_effects(self, element: etree._Element, effects: Iterable[Effect]) -> None:
        for effect in effects:
            match effect:
                case Assignment(variable=variable, path=path, value=value):
                    location = self._location(variable, path)
                    add(element, "assign", location=location, expr=stored(value, self.dialect))
                case Cancel(event=event):
                    self.delayed.cancel(element, event)
                case Send(event=event, arguments=arguments, to=to, delay=delay):
                    target = address(to, self.dialect) if to is not None else None
                    wait = self._delay(delay) if delay is not None else {}
                    sending = add(
                        element, "send", event=event, type=SEND_TYPE, targetexpr=target, **wait
                    )
                    if delay is not None:
                        self.delayed.send(sending, event)
                    for name, value in arguments:
                        add(sending, "param", name=name, expr=stored(value, self.dialect))

    def _location(self, variable: str, path: tuple[str, ...]) -> str:
        return ".".join((self.dialect.variable(variable), *path))
