"""Interfaces, functions, components, members and swarms as elements."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeVar

from swarmdsl.ir import (
    Action,
    Component,
    Event,
    Expression,
    Field,
    Function,
    Interface,
    Member,
    Message,
    Optimization,
    Param,
    Part,
    Port,
    Service,
    Swarm,
    System,
)
from swarmdsl.tools.compare.behaviour import machine_element
from swarmdsl.tools.compare.elements import (
    Element,
    Ref,
    Value,
    assigned,
    joined,
    said,
    type_of,
    with_doc,
    written,
)

T = TypeVar("T")


def system_element(system: System) -> Element:
    """Everything that is declared; what libraries bring is not."""
    children = (
        *(_interface(each) for each in system.interfaces),
        *(_event(each) for each in system.events),
        *(_function(each) for each in system.functions if not each.in_library),
        *_components(system),
        *_members(system),
        *(machine_element(each, system) for each in system.machines),
        *_others(system),
        *(_swarm(each) for each in system.swarms),
        *(_optimization(each) for each in system.optimizations),
    )
    root = Element("model", (system.name,), (), children, origin=system.origin)
    return with_doc(root, system.doc)


def _named(name: str | None, kind: str) -> Value:
    return (Ref(kind, name),) if name is not None else ()


def _interface(interface: Interface) -> Element:
    parts: dict[str, tuple[Field, ...]]
    constants: tuple[Element, ...] = ()
    match interface:
        case Message():
            kind, parts = "message", {"field": interface.fields}
            constants = tuple(
                Element(
                    "constant",
                    (each.name,),
                    said(type=type_of(each.type), value=written(each.value)),
                    origin=each.origin,
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
    # What the model only describes is defined elsewhere.
    values = said(described=interface.external)
    element = Element(
        kind, (name,), values, (*constants, *fields), Ref("interface", name), interface.origin
    )
    return with_doc(element, interface.doc)


def _field(each: Field, kind: str) -> Element:
    made = Element(kind, (each.name,), said(type=type_of(each.type)), origin=each.origin)
    return with_doc(made, each.doc)


def _event(event: Event) -> Element:
    values = said(
        type=type_of(event.type), topic=event.topic, reach="swarm" if event.swarm else "member"
    )
    element = Element(
        "event", (event.name,), values, ref=Ref("event", event.name), origin=event.origin
    )
    return with_doc(element, event.doc)


def _function(function: Function) -> Element:
    call = function.communication
    values = said(
        category=function.category,
        paradigm=call.paradigm,
        server=call.name,
        type=type_of(call.type),
    )
    ports = (
        Element(
            f"{port.direction} port",
            (port.topic,),
            said(type=type_of(port.type)),
            origin=port.origin,
        )
        for port in function.ports
    )
    children = (*ports, *params(function.params))
    ref = Ref("function", function.name)
    element = Element("function", (function.name,), values, children, ref, function.origin)
    return with_doc(element, function.doc)


def params(declared: Iterable[Param]) -> Iterator[Element]:
    """The params of something."""
    for param in declared:
        default = param.declared if param.declared is not None else param.default
        values = said(type=type_of(param.type), default=written(default))
        yield with_doc(Element("param", (param.name,), values, origin=param.origin), param.doc)


def _ports(ports: Iterable[Port]) -> Iterator[Element]:
    for port in ports:
        values = said(direction=port.direction, type=type_of(port.type), topic=port.topic)
        yield with_doc(Element("port", (port.name,), values, origin=port.origin), port.doc)


def _own(items: Sequence[T], base: Sequence[T]) -> list[T]:
    """The items that are not just inherited."""
    return [item for item in items if item not in base]


def _components(system: System) -> Iterator[Element]:
    known = {component.name: component for component in system.components}
    for each in system.components:
        base = known.get(each.base or "")
        values = said(
            kind=each.kind,
            extends=_named(each.base, "component"),
            behavior=_named(each.behavior, "statemachine")
            if base is None or each.behavior != base.behavior
            else (),
            operations=_operations(each, base),
        )
        children = (
            *_ports(_own(each.ports, base.ports if base else ())),
            *params(_own(each.params, base.params if base else ())),
        )
        ref = Ref("component", each.name)
        yield with_doc(
            Element("component", (each.name,), values, children, ref, each.origin), each.doc
        )


def _operations(component: Component, base: Component | None) -> Value:
    own = _own(component.operations, base.operations if base else ())
    return joined((_named(name, "function") for name in own), ", ")


def _members(system: System) -> Iterator[Element]:
    known = {member.name: member for member in system.members}
    for each in system.members:
        base = known.get(each.base or "")
        values = said(
            extends=_named(each.base, "member"),
            behavior=_named(each.behavior, "statemachine")
            if base is None or each.behavior != base.behavior
            else (),
            communication=_communication(each, base),
        )
        children = (
            *_ports(_own(each.ports, base.ports if base else ())),
            *params(_own(each.params, base.params if base else ())),
            *(_part(part) for part in _own(each.parts, base.parts if base else ())),
            *(
                Element("connector", (f"{line.source} -> {line.target}",), origin=line.origin)
                for line in _own(each.connectors, base.connectors if base else ())
            ),
        )
        ref = Ref("member", each.name)
        yield with_doc(
            Element("member", (each.name,), values, children, ref, each.origin), each.doc
        )


def _communication(member: Member, base: Member | None) -> Value:
    settings = member.communication
    if settings is None or (base is not None and settings == base.communication):
        return ()
    values = assigned(settings.values)
    return (settings.technology, *((" ", *values) if values else ()))


def _part(part: Part) -> Element:
    values = said(component=_named(part.component, "component"), values=assigned(part.values))
    return with_doc(Element("part", (part.name,), values, origin=part.origin), part.doc)


def _others(system: System) -> Iterator[Element]:
    for world in system.environments:
        size = " x ".join(f"{length:g}" for length in world.size or ())
        values = said(world=world.world, size=f"{size} m" if size else "")
        ref = Ref("environment", world.name)
        made = Element("environment", (world.name,), values, (), ref, world.origin)
        yield with_doc(made, world.doc)
    for fitness in system.fitness:
        values = ((fitness.goal, written(fitness.value)),)
        inputs = (_field(each, "input") for each in fitness.inputs)
        ref = Ref("fitness", fitness.name)
        children = (*inputs, *params(fitness.params))
        made = Element("fitness", (fitness.name,), values, children, ref, fitness.origin)
        yield with_doc(made, fitness.doc)


def _swarm(swarm: Swarm) -> Element:
    roles = (
        with_doc(
            Element(
                "role",
                (role.name,),
                said(member=_named(role.member, "member"), number=str(role.multiplicity)),
                origin=role.origin,
            ),
            role.doc,
        )
        for role in swarm.roles
    )
    values = said(
        environment=_named(swarm.environment, "environment"),
        fitness=_named(swarm.fitness, "fitness"),
    )
    ref = Ref("swarm", swarm.name)
    element = Element("swarm", (swarm.name,), values, tuple(roles), ref, swarm.origin)
    return with_doc(element, swarm.doc)


def _optimization(search: Optimization) -> Element:
    ranges = [
        Element(
            "range",
            (f"{each.role}.{each.param}",),
            said(values=_range(each.lower, each.upper), step=written(each.step)),
            origin=each.origin,
        )
        for each in search.params
    ]
    ranges += (
        Element(
            "range",
            (f"number of {each.role}",),
            said(values=_range(each.lower, each.upper)),
            origin=each.origin,
        )
        for each in search.counts
    )
    settings = tuple((name, written(value)) for name, value in search.settings)
    element = Element(
        "optimization", (Ref("swarm", search.swarm),), settings, tuple(ranges), None, search.origin
    )
    return with_doc(element, search.doc)


def _range(lower: Expression, upper: Expression) -> Value:
    return (*written(lower), "..", *written(upper))
