"""Components, and members with their parts and contracts, as elements."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeVar

from swarmdsl.codegen.swarm_printer.architecture import equipment
from swarmdsl.ir import Component, Contract, Docs, Member, Part, Port, System
from swarmdsl.tools.compare.behaviour import param_elements
from swarmdsl.tools.compare.elements import (
    Element,
    Ref,
    Value,
    argument_values,
    expression_value,
    join_values,
    properties,
    reference,
    type_value,
    with_doc,
)
from swarmdsl.tools.compare.sentences import machines_of, state_value
from swarmdsl.tools.compare.space import sight_elements

T = TypeVar("T")


def _ports(ports: Iterable[Port]) -> Iterator[Element]:
    for port in ports:
        values = properties(direction=port.direction, type=type_value(port.type), topic=port.topic)
        yield with_doc(Element("port", (port.name,), values, origin=port.origin), port.doc)


def _own(items: Sequence[T], base: Sequence[T]) -> list[T]:
    """Return the items that are not inherited from `base`."""
    return [item for item in items if item not in base]


def component_elements(system: System) -> Iterator[Element]:
    """Yield the components, each with what it does not inherit."""
    known = system.components_by_name
    for each in system.components:
        base = known.get(each.base or "")
        values = properties(
            kind=each.kind,
            extends=reference(each.base, "component"),
            behavior=reference(each.behavior, "statemachine")
            if base is None or each.behavior != base.behavior
            else (),
            operations=_operations(each, base),
        )
        children = (
            *_ports(_own(each.ports, base.ports if base else ())),
            *param_elements(_own(each.params, base.params if base else ())),
            *sight_elements(_own(each.sights, base.sights if base else ())),
        )
        ref = Ref("component", each.name)
        yield with_doc(
            Element("component", (each.name,), values, children, ref, each.origin),
            each.doc,
            tuple(_own(each.docs, base.docs if base else ())),
        )


def _operations(component: Component, base: Component | None) -> Value:
    own = _own(component.operations, base.operations if base else ())
    return join_values((reference(name, "function") for name in own), ", ")


def member_elements(system: System) -> Iterator[Element]:
    """Yield the members, each with what it does not inherit."""
    known = system.members_by_name
    for each in system.members:
        base = known.get(each.base or "")
        values = properties(
            extends=reference(each.base, "member"),
            behavior=reference(each.behavior, "statemachine")
            if base is None or each.behavior != base.behavior
            else (),
            communication=_communication(each, base),
            **{kind: _equipment(each, base, kind) for kind in ("body", "battery", "radio")},
        )
        children = (
            *_ports(_own(each.ports, base.ports if base else ())),
            *param_elements(_own(each.params, base.params if base else ())),
            *(_part(part) for part in _own(each.parts, base.parts if base else ())),
            *(
                with_doc(
                    Element("connector", (f"{line.source} -> {line.target}",), origin=line.origin),
                    line.doc,
                )
                for line in _own(each.connectors, base.connectors if base else ())
            ),
            *(
                _contract(one, each, system)
                for one in _own(each.contracts, base.contracts if base else ())
            ),
        )
        ref = Ref("member", each.name)
        yield with_doc(
            Element("member", (each.name,), values, children, ref, each.origin),
            each.doc,
            tuple(_own(_member_docs(each), _member_docs(base) if base else ())),
        )


def _contract(contract: Contract, member: Member, system: System) -> Element:
    machines = machines_of([member], system)
    states: list[Value] = [(state_value(name, machines),) for name in contract.states]
    events: list[Value] = [(Ref("event", name),) for name in contract.events]
    values = properties(
        on=join_values(events, ", "),
        guard=expression_value(contract.guard),
        within=expression_value(contract.within),
        reach=join_values(states, ", "),
        call=reference(contract.function, "function"),
    )
    element = Element("contract", (contract.name,), values, origin=contract.origin)
    return with_doc(element, contract.doc)


def _member_docs(member: Member) -> Docs:
    settings = member.communication
    if settings is None:
        return member.docs
    return (*member.docs, (settings.technology, settings.doc), *settings.docs)


def _communication(member: Member, base: Member | None) -> Value:
    settings = member.communication
    if settings is None or (base is not None and settings == base.communication):
        return ()
    values = argument_values(settings.values)
    return (settings.technology, *((" ", *values) if values else ()))


def _equipment(member: Member, base: Member | None, kind: str) -> Value:
    values, _ = equipment(member, kind)
    inherited = base is not None and values == equipment(base, kind)[0]
    return () if inherited else argument_values(values)


def _part(part: Part) -> Element:
    values = properties(
        component=reference(part.component, "component"), values=argument_values(part.values)
    )
    return with_doc(Element("part", (part.name,), values, origin=part.origin), part.doc, part.docs)
