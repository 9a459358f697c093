"""The CPSwarm profile: SCXML for the CPSwarm code generator.

Constructs that this dialect lacks, or that would break that generator, are reported. The
generator's rules determine the form: ids become Python names, so they differ in more than case;
types are `package/Class`; strings end up in single quotes, unescaped; every call has a result.
"""

from __future__ import annotations

from collections.abc import Iterable

from lxml import etree

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import replace
from swarmdsl.base.source import Span
from swarmdsl.codegen.api import Feature
from swarmdsl.codegen.exchange.scxml.calls import Call, call_of
from swarmdsl.codegen.exchange.scxml.cpswarm_messages import in_profile, without_initializers
from swarmdsl.codegen.exchange.scxml.cpswarm_structure import (
    OUTCOMES,
    TARGET,
    Monitor,
    Vertex,
    event_name,
    shape,
)
from swarmdsl.codegen.exchange.scxml.userdata import missing
from swarmdsl.codegen.exchange.scxml.xml import SCXML, add, add_text, root
from swarmdsl.codegen.features import used_features
from swarmdsl.codegen.xml_tree import Places, add_comment
from swarmdsl.ir import Activity, Event, Named, Policy, State, StateMachine, System

CPSWARM = "http://my.custom-actions.domain/cpswarm/CUSTOM"

_UNSUPPORTED = {
    Feature.CHOICE,
    Feature.GUARD,
    Feature.ASSIGNMENT,
    Feature.SEND,
    Feature.DELAYED_SEND,
    Feature.DEFER,
    Feature.TIMEOUT,
    Feature.HISTORY,
    Feature.ENTRY,
    Feature.EXIT,
    Feature.INTERNAL,
    Feature.TARGETLESS,
    Feature.EVENTLESS,
    Feature.IN_STATE,
    Feature.ELAPSED,
    Feature.MEMBER_EVENT,
}


def cpswarm(
    machine: StateMachine, system: System, report: Diagnostics, places: Places
) -> etree._Element | None:
    """Return the document of a machine, or None if it cannot be expressed (reported).

    The origins of its elements are added to `places`.
    """
    found = Diagnostics()
    written = without_initializers(machine)
    for feature, origin in used_features(replace(system, machines=(written,))):
        if feature in _UNSUPPORTED:
            _refuse(found, feature.value, origin)
    if not found.has_errors:
        document = _document(machine, system, found, places)
    report.include(in_profile(machine, found))
    return None if found.has_errors else document


def _document(
    machine: StateMachine, system: System, report: Diagnostics, places: Places
) -> etree._Element:
    shaped = shape(machine, report)
    writer = _Writer(machine, system, shaped, report, places)
    # SMACH starts with the first state, so it is the first element.
    document = root(
        {None: SCXML, "cpswarm": CPSWARM},
        version="1.0",
        initial=writer.entries.get(machine.initial),
        name=machine.name,
    )
    add_comment(document, machine.doc)
    for vertex in shaped:
        writer.add_vertex(document, vertex)
    for variable, what in missing(machine, shaped):
        report.report("complete-by-hand", variable.origin, path=file_name(machine), what=what)
    return document


def file_name(machine: StateMachine) -> str:
    """Return the name of a machine's file."""
    return f"{machine.name}.cpswarm.xml"


class _Ids:
    """Ids of elements, distinct as Python variables in lower case."""

    def __init__(self) -> None:
        # The generator's own variable for the machine is `top_sm`.
        self.taken = {"top"}
        self._last_numbers: dict[str, int] = {}

    def new(self, *candidates: str) -> str:
        """Return the first free candidate, or the last one with a number."""
        free = next((each for each in candidates if each.casefold() not in self.taken), None)
        if free is None:
            last = candidates[-1]
            number = self._last_numbers.get(last, 1)
            while free is None or free.casefold() in self.taken:
                number += 1
                free = f"{last}{number}"
            self._last_numbers[last] = number
        self.taken.add(free.casefold())
        return free


class _Writer:
    def __init__(
        self,
        machine: StateMachine,
        system: System,
        shaped: Iterable[Vertex],
        report: Diagnostics,
        places: Places,
    ) -> None:
        self.machine = machine
        self.places = places
        self.system = system
        self.report = report
        self.ids = _Ids()
        self.events: dict[str, str] = {}
        vertices = [vertex for top in shaped for vertex in top.walk()]
        names = {vertex.state.id: _candidates(vertex.state) for vertex in vertices}
        own = {
            (v.state.id, v.suffix): self.ids.new(*(name + v.suffix for name in names[v.state.id]))
            for v in vertices
        }
        self.own = own
        # A transition to a state leads to the outermost element made from it.
        self.entries: dict[str, str] = {}
        for vertex in vertices:
            self.entries.setdefault(vertex.state.id, own[vertex.state.id, vertex.suffix])

    def add_vertex(self, parent: etree._Element, vertex: Vertex) -> None:
        """Add an element and those in it."""
        state = vertex.state
        element = add(
            parent,
            "parallel" if vertex.parallel else "state",
            id=self.own[state.id, vertex.suffix],
        )
        self.places[element] = state.origin
        if self.own[state.id, vertex.suffix] == self.entries[state.id]:
            add_comment(element, state.doc)
        if not vertex.children and state.activity is not None:
            self._add_call(element, state, state.activity)
        for child in vertex.children:
            if isinstance(child, Monitor):
                self._add_monitor(element, child)
            else:
                self.add_vertex(element, child)
        for event, target in vertex.transitions:
            add(element, "transition", event=event, target=self.entries[target])

    def _add_monitor(self, parent: etree._Element, monitor: Monitor) -> None:
        event = self.system.event(monitor.event)
        self._check_event(event)
        name = event.name[0].upper() + event.name[1:]
        identifier = self.ids.new(f"{name}Monitoring", f"{monitor.state.name}{name}Monitoring")
        element = add(parent, "state", id=identifier)
        self.places[element] = event.origin
        invoked = add(add(element, "datamodel"), "data", id="invoke")
        body = add(invoked, "rosmonitor")
        add_text(body, "topic", self._quotable(event.incoming_topic, "a topic", event.origin))
        add_text(body, "msg", str(event.type))
        add(element, "invoke", type="ROS_MONITOR")

    def _check_event(self, event: Event) -> None:
        name = event_name(event.name)
        other = self.events.setdefault(name, event.name)
        if name in OUTCOMES or other != event.name:
            self._bad_name(event.name, f"an event: it would be `{name}`", event.origin)
        if not isinstance(event.type, Named):
            _refuse(self.report, f"an event of type `{event.type}`", event.origin)

    def _add_call(self, element: etree._Element, state: State, activity: Activity) -> None:
        call = call_of(activity, self.machine, self.system)
        self._check_call(state, activity, call)
        communication = call.function.communication
        add_comment(element, activity.doc)
        model = add(element, "datamodel")
        if call.is_action and any(port.direction == "in" for port in call.function.ports):
            # Requests a skeleton. The generator fails on a function without inputs, and
            # creates an action server for a service.
            add_text(add(model, "data", id="adf"), "name", call.function.name)
        invoked = add(model, "data", id="invoke")
        body = add(invoked, "rosaction" if call.is_action else "rosservice")
        name = self._quotable(communication.name, "the name of a server", communication.origin)
        add_text(body, "name", name)
        add_text(body, "action" if call.is_action else "srv", str(communication.type))
        goal = add(body, "goal" if call.is_action else "request", type=call.goal.value)
        tag = "param" if call.goal is Policy.FIXED else "var"
        for item in call.goal_items:
            add_text(goal, tag, item)
        result = add(body, "result" if call.is_action else "response", type=call.result.value)
        for field in call.result_fields:
            add_text(result, "var", field)
        if call.mappings:
            mappings = add(invoked, "mappings")
            for field, key in call.mappings:
                pair = add(mappings, "map")
                add_text(pair, "x", field)
                add_text(pair, "y", key)
        add(element, "invoke", type="ROS_ACTION" if call.is_action else "ROS_SERVICE")

    def _check_call(self, state: State, activity: Activity, call: Call) -> None:
        for result in activity.results:
            if result.path:
                _refuse(self.report, "a result stored in a field of a variable", result.origin)
        if call.is_action and call.result is Policy.CALLBACK:
            # The generator defines the callback under another name than it calls.
            _refuse(self.report, "a callback for the result of an action", activity.origin)
        if call.completion:
            goal = "goal" if call.is_action else "request"
            lines = [f"`{goal}.{field} = {value}`" for field, value in call.completion]
            self.report.report(
                "complete-by-hand",
                activity.origin,
                notes=(f"its code is {', '.join(lines)}",),
                path=file_name(self.machine),
                what=f"the callback for the {goal} of `{state.name}` is empty",
            )

    def _quotable(self, text: str, use: str, origin: Span | None) -> str:
        if any(character in "'\\" or not character.isprintable() for character in text):
            self._bad_name(text, use, origin)
        return text

    def _bad_name(self, name: str, use: str, origin: Span | None) -> None:
        self.report.report("bad-identifier", origin, target=TARGET, name=name, use=use)


def _candidates(state: State) -> tuple[str, str]:
    return state.name, state.id.replace(".", "_")


def _refuse(report: Diagnostics, construct: str, origin: Span | None) -> None:
    report.report("unsupported-construct", origin, target=TARGET, construct=construct)
