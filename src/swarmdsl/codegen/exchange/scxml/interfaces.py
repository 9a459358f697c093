"""Interfaces that a machine uses in events, calls and data."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from lxml import etree

from swarmdsl.codegen.exchange.scxml.ecmascript import dialect
from swarmdsl.codegen.exchange.scxml.xml import add_doc, add_payload
from swarmdsl.ir import Action, Array, Field, Interface, Message, Service, System, Type
from swarmdsl.ir.expression_printer import translate
from swarmdsl.syntax.types import unit_name


def describe_interfaces(root: etree._Element, types: Iterable[Type], system: System) -> None:
    """Add the used interfaces that the model describes, and those in their fields."""
    used: set[Type] = set()
    waiting = list(types)
    while waiting:
        type_ = waiting.pop()
        while isinstance(type_, Array):
            type_ = type_.element
        if type_ in used:
            continue
        used.add(type_)
        for interface in system.interfaces_of([type_]):
            for _, fields in _parts(interface):
                waiting += [field.type for field in fields]
    for interface in system.interfaces_of(used):
        _describe(root, interface)


def _parts(interface: Interface) -> Iterator[tuple[str, tuple[Field, ...]]]:
    match interface:
        case Message(fields=fields):
            yield "message", fields
        case Service(request=request, response=response):
            yield from (("request", request), ("response", response))
        case Action(goal=goal, result=result, feedback=feedback):
            yield from (("goal", goal), ("result", result), ("feedback", feedback))


def _describe(root: etree._Element, interface: Interface) -> None:
    element = add_payload(
        *(root, type(interface).__name__.lower()),
        type=str(interface.type),
        external="true" if interface.external else "false",
    )
    add_doc(element, interface.doc)
    if isinstance(interface, Message):
        for constant in interface.constants:
            given = add_payload(
                *(element, "constant"),
                name=constant.name,
                type=str(constant.type),
                unit=unit_name(constant.type),
                value=translate(constant.value, dialect({})),
            )
            add_doc(given, constant.doc)
    for name, fields in _parts(interface):
        if not fields:
            continue
        inside = element if name == "message" else add_payload(element, "part", name=name)
        for field in fields:
            described = add_payload(
                *(inside, "field"),
                name=field.name,
                type=str(field.type),
                unit=unit_name(field.type),
            )
            add_doc(described, field.doc)
