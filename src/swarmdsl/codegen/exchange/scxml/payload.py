"""Elements for ROS, types and documentation, in a namespace of our own.

SCXML has no words for them. The elements are directly below `<scxml>` and `<state>`; engines
skip them, and an importer restores the IR from them. Expressions are in the document's data
model.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from lxml import etree

from swarmdsl.codegen.exchange.content_policy import goal_policy, result_policy
from swarmdsl.codegen.exchange.scxml.ecmascript import SELF
from swarmdsl.codegen.exchange.scxml.effects import effects_of
from swarmdsl.codegen.exchange.scxml.interfaces import describe_interfaces
from swarmdsl.codegen.exchange.scxml.xml import add_doc, add_payload
from swarmdsl.codegen.shared.constants import params_by_name
from swarmdsl.codegen.shared.identity import uses_self
from swarmdsl.codegen.swarm_printer.expressions import duration
from swarmdsl.ir import (
    Activity,
    Cancel,
    Delivery,
    EventTrigger,
    Param,
    Send,
    State,
    StateKind,
    StateMachine,
    System,
    Type,
    Variable,
    doc_of,
)
from swarmdsl.ir.docs import Docs
from swarmdsl.ir.expression_printer import Dialect, translate
from swarmdsl.syntax.types import unit_name


def describe_machine(
    root: etree._Element, machine: StateMachine, system: System, data: Mapping[str, str]
) -> None:
    """Add the types and docs of the machine, its events and functions."""
    add_payload(root, "model", package=system.name)
    add_doc(root, machine.doc)
    _add_initial(root, machine.docs)
    if machine.endless:
        add_payload(root, "endless")
    if uses_self(machine):
        add_payload(root, "identity", location=SELF)
    types: list[Type] = []
    for event in system.events_of(_events(machine)):
        types.append(event.type)
        element = add_payload(
            root,
            "event",
            name=event.name,
            type=str(event.type),
            topic=event.topic,
            swarm="true" if event.swarm else "false",
            operator="true" if event.operator else None,
            **_delivery(event.delivery),
        )
        add_doc(element, event.doc)
    called = {state.activity.function for state in machine.walk() if state.activity is not None}
    for function in system.functions_of(called):
        types.append(function.communication.type)
        element = add_payload(
            root,
            "function",
            name=function.name,
            category=function.category,
            paradigm=function.communication.paradigm,
            server=function.communication.name,
            type=str(function.communication.type),
        )
        add_doc(element, function.doc)
    for tag, items in (("parameter", machine.params), ("variable", machine.variables)):
        for item in items:
            types.append(item.type)
            unset = isinstance(item, Variable) and item.initial is None
            element = add_payload(
                *(root, tag),
                name=item.name,
                type=str(item.type),
                unit=unit_name(item.type),
                location=data[item.name],
                # The value in the document is then the default of the type.
                initial="default" if unset else None,
            )
            add_doc(element, item.doc)
    describe_interfaces(root, types, system)


def _delivery(delivery: Delivery | None) -> dict[str, str | None]:
    """Return the attributes of a delivery; times are in microseconds or a longer unit."""
    if delivery is None:
        return {}
    times = {"lifespan": delivery.lifespan, "deadline": delivery.deadline}
    return {
        "reliability": {True: "reliable", False: "best-effort", None: None}[delivery.reliable],
        "latest": "true" if delivery.latest else None,
        "keep": str(delivery.keep) if delivery.keep is not None else None,
        **{name: duration(time) for name, time in times.items() if time is not None},
    }


def describe_state(
    element: etree._Element,
    state: State,
    machine: StateMachine,
    dialect: Dialect,
    since: str | None,
) -> None:
    """Add the time of entry, the deferred events, the activity and the docs of a state."""
    add_doc(element, state.doc)
    _add_initial(element, state.docs)
    name = state.name if state.name != element.get("id") else None
    kind = state.kind.value if state.kind is StateKind.CHOICE else None
    if name or kind:
        # Not called `state`: some engines ignore namespaces.
        add_payload(element, "vertex", name=name, kind=kind)
    if state.submachine is not None:
        add_payload(element, "submachine", name=state.submachine)
    if since is not None:
        add_payload(element, "since", location=since)
    if state.deferred:
        events = " ".join(trigger.event for trigger in state.deferred)
        add_doc(add_payload(element, "defer", event=events), doc_of(state.docs, "defer"))
    if state.activity is not None:
        _activity(element, state.activity, params_by_name(machine.params), dialect)


def _add_initial(parent: etree._Element, docs: Docs) -> None:
    """Add the docs of the first state; not called `initial`, as above."""
    text = doc_of(docs, "initial")
    if text:
        add_doc(add_payload(parent, "first"), text)


def _activity(
    parent: etree._Element, activity: Activity, params: Mapping[str, Param], dialect: Dialect
) -> None:
    element = add_payload(parent, "activity", function=activity.function)
    add_doc(element, activity.doc)
    goal = add_payload(
        element,
        "goal",
        policy=goal_policy(activity, params).value,
        callback=activity.goal_callback,
    )
    for field, value in activity.arguments:
        add_payload(goal, "argument", field=field, expr=translate(value, dialect))
    result = add_payload(
        element,
        "result",
        policy=result_policy(activity).value,
        callback=activity.result_callback,
    )
    for mapping in activity.results:
        location = ".".join((dialect.variable(mapping.variable), *mapping.path))
        add_payload(result, "mapping", field=mapping.field, location=location)


def _events(machine: StateMachine) -> Iterator[str]:
    for state in machine.walk():
        yield from (trigger.event for trigger in state.deferred)
        for transition in state.transitions:
            for trigger in transition.triggers:
                if isinstance(trigger, EventTrigger):
                    yield trigger.event
    for effect in effects_of(machine):
        if isinstance(effect, (Send, Cancel)):
            yield effect.event
