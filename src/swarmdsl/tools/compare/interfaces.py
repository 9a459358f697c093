"""Interfaces, events and functions as elements."""

from __future__ import annotations

from swarmdsl.codegen.swarm_printer.delivery import delivery_settings
from swarmdsl.codegen.swarm_printer.space import model
from swarmdsl.ir import Action, Event, Field, Function, Interface, Message, Service
from swarmdsl.tools.compare.behaviour import param_elements
from swarmdsl.tools.compare.elements import (
    Element,
    Ref,
    expression_value,
    properties,
    type_value,
    with_doc,
)


def interface_element(interface: Interface) -> Element:
    """Return an interface with its fields and constants."""
    parts: dict[str, tuple[Field, ...]]
    constants: tuple[Element, ...] = ()
    match interface:
        case Message():
            kind, parts = "message", {"field": interface.fields}
            constants = tuple(
                with_doc(
                    Element(
                        "constant",
                        (each.name,),
                        properties(type=type_value(each.type), value=expression_value(each.value)),
                        origin=each.origin,
                    ),
                    each.doc,
                )
                for each in interface.constants
            )
        case Service(request=request, response=response):
            kind, parts = "service", {"request field": request, "response field": response}
        case Action(goal=goal, result=result, feedback=feedback):
            kind = "action"
            parts = {"goal field": goal, "result field": result, "feedback field": feedback}
    fields = tuple(_field(each, word) for word, part in parts.items() for each in part)
    name = str(interface.type)
    # An external interface is only described here; another package defines it.
    values = properties(described=interface.external)
    element = Element(
        kind, (name,), values, (*constants, *fields), Ref("interface", name), interface.origin
    )
    return with_doc(element, interface.doc)


def _field(each: Field, kind: str) -> Element:
    element = Element(
        kind, (each.name,), properties(type=type_value(each.type)), origin=each.origin
    )
    return with_doc(element, each.doc)


def event_element(event: Event) -> Element:
    """Return an event with its delivery."""
    values = properties(
        type=type_value(event.type),
        topic=event.topic,
        reach="swarm" if event.swarm else "member",
        operator=event.operator,
        delivery=", ".join(delivery_settings(event.delivery)),
    )
    name, given = event.name, event.delivery
    places = (("delivery", given.origin),) if given is not None else ()
    element = Element(
        "event", (name,), values, ref=Ref("event", name), origin=event.origin, places=places
    )
    return with_doc(element, event.doc)


def function_element(function: Function) -> Element:
    """Return a function with its ports, params and model."""
    call, use = function.communication, function.model
    values = properties(
        category=function.category,
        paradigm=call.paradigm,
        server=call.name,
        type=type_value(call.type),
        model=model(use) if use is not None else "",
    )
    ports = (
        with_doc(
            Element(
                f"{port.direction} port",
                (port.topic,),
                properties(type=type_value(port.type)),
                origin=port.origin,
            ),
            port.doc,
        )
        for port in function.ports
    )
    children = (*ports, *param_elements(function.params))
    ref = Ref("function", function.name)
    places = (("model", use.origin),) if use is not None else ()
    element = Element("function", (function.name,), values, children, ref, function.origin, places)
    docs = (("call", call.doc), ("model", use.doc if use is not None else ""))
    return with_doc(element, function.doc, docs)
