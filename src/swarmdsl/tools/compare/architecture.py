"""Interfaces, functions, components, members and swarms as elements."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeVar

from swarmdsl.analysis.resolve.properties import matches
from swarmdsl.codegen.swarm_printer.architecture import equipment
from swarmdsl.codegen.swarm_printer.composition import heartbeat
from swarmdsl.codegen.swarm_printer.delivery import delivery_settings
from swarmdsl.codegen.swarm_printer.space import model, start
from swarmdsl.ir import (
    Action,
    Component,
    Contract,
    Docs,
    Event,
    Expression,
    Field,
    Fitness,
    FitnessInput,
    Function,
    Interface,
    Member,
    Message,
    Optimization,
    Part,
    Port,
    Property,
    RobotValues,
    Role,
    Service,
    StateMachine,
    Swarm,
    System,
    sentences,
)
from swarmdsl.ir.sentences import sentence
from swarmdsl.tools.compare.behaviour import declared_names, machine_element, param_elements
from swarmdsl.tools.compare.elements import (
    ROBOT_KIND,
    Element,
    Ref,
    Value,
    argument_values,
    expression_value,
    join_values,
    properties,
    role_kind,
    state_kind,
    type_value,
    with_doc,
    with_names,
)
from swarmdsl.tools.compare.space import sight_elements, space_elements

T = TypeVar("T")


def model_element(system: System) -> Element:
    """Tree of all declarations of a model, without library elements."""
    children = (
        *(_interface(each) for each in system.interfaces),
        *(_event(each) for each in system.events if not each.predefined),
        *(_function(each) for each in system.functions if not each.in_library),
        *_components(system),
        *_members(system),
        *(machine_element(each, system) for each in system.machines),
        *_others(system),
        *(_swarm(each) for each in system.swarms),
        *(_optimization(each) for each in system.optimizations),
        *(_property(each, system) for each in system.properties),
    )
    root = Element("model", (system.name,), (), children, origin=system.origin)
    return with_doc(with_names(root, declared_names(system.machines)), system.doc)


def _named(name: str | None, kind: str) -> Value:
    return (Ref(kind, name),) if name is not None else ()


def _interface(interface: Interface) -> Element:
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


def _event(event: Event) -> Element:
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


def _function(function: Function) -> Element:
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


def _ports(ports: Iterable[Port]) -> Iterator[Element]:
    for port in ports:
        values = properties(direction=port.direction, type=type_value(port.type), topic=port.topic)
        yield with_doc(Element("port", (port.name,), values, origin=port.origin), port.doc)


def _own(items: Sequence[T], base: Sequence[T]) -> list[T]:
    """Return the items that are not inherited from `base`."""
    return [item for item in items if item not in base]


def _components(system: System) -> Iterator[Element]:
    known = system.components_by_name
    for each in system.components:
        base = known.get(each.base or "")
        values = properties(
            kind=each.kind,
            extends=_named(each.base, "component"),
            behavior=_named(each.behavior, "statemachine")
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
    return join_values((_named(name, "function") for name in own), ", ")


def _members(system: System) -> Iterator[Element]:
    known = system.members_by_name
    for each in system.members:
        base = known.get(each.base or "")
        values = properties(
            extends=_named(each.base, "member"),
            behavior=_named(each.behavior, "statemachine")
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
    machines = _machines_of([member], system)
    states: list[Value] = [(_state(name, machines),) for name in contract.states]
    events: list[Value] = [(Ref("event", name),) for name in contract.events]
    values = properties(
        on=join_values(events, ", "),
        guard=expression_value(contract.guard),
        within=expression_value(contract.within),
        reach=join_values(states, ", "),
        call=_named(contract.function, "function"),
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
        component=_named(part.component, "component"), values=argument_values(part.values)
    )
    return with_doc(Element("part", (part.name,), values, origin=part.origin), part.doc, part.docs)


def _others(system: System) -> Iterator[Element]:
    for world in system.environments:
        size = " x ".join(f"{length:g}" for length in world.size or ())
        values = properties(world=world.world, size=f"{size} m" if size else "")
        ref = Ref("environment", world.name)
        children = tuple(space_elements(world))
        element = Element("environment", (world.name,), values, children, ref, world.origin)
        yield with_doc(element, world.doc, world.docs)
    for fitness in system.fitness:
        values = ((fitness.goal, expression_value(fitness.value)),)
        values += properties(about=_named(fitness.subject, "swarm"))
        inputs = (_input(each, fitness, system) for each in fitness.inputs)
        ref = Ref("fitness", fitness.name)
        children = (*inputs, *param_elements(fitness.params))
        element = Element("fitness", (fitness.name,), values, children, ref, fitness.origin)
        yield with_doc(element, fitness.doc, fitness.docs)


def _robot(swarm: Swarm, role: Role, robot: RobotValues) -> Element:
    name = (Ref(role_kind(swarm.name), role.name), f"[{robot.index}]")
    values = properties(start=start(robot.start).strip(), values=argument_values(robot.values))
    return with_doc(Element(ROBOT_KIND, name, values, origin=robot.origin), robot.doc, robot.docs)


def _swarm(swarm: Swarm) -> Element:
    roles = (
        with_doc(
            Element(
                "role",
                (role.name,),
                properties(
                    member=_named(role.member, "member"),
                    number=str(role.multiplicity),
                    start=start(role.start).strip(),
                    values=argument_values(role.values),
                ),
                ref=Ref(role_kind(swarm.name), role.name),
                origin=role.origin,
            ),
            role.doc,
            role.docs,
        )
        for role in swarm.roles
    )
    values = properties(
        environment=_named(swarm.environment, "environment"),
        fitness=_named(swarm.fitness, "fitness"),
        heartbeat=heartbeat(swarm.heartbeat).removeprefix("heartbeat ") if swarm.heartbeat else "",
    )
    ref = Ref("swarm", swarm.name)
    robots = (_robot(swarm, role, robot) for role in swarm.roles for robot in role.robots)
    beat = swarm.heartbeat
    places = (("heartbeat", beat.origin),) if beat is not None else ()
    children = (*roles, *robots)
    element = Element("swarm", (swarm.name,), values, children, ref, swarm.origin, places)
    docs = swarm.docs if beat is None or not beat.doc else (*swarm.docs, ("heartbeat", beat.doc))
    return with_doc(element, swarm.doc, docs)


def _property(each: Property, system: System) -> Element:
    kind = "statemachine" if each.subject in system.machines_by_name else "swarm"
    says = _says(sentence(each), each.each, each.subject, system)
    values = properties(about=_named(each.subject, kind), says=says)
    ref = Ref("property", each.name)
    return with_doc(Element("property", (each.name,), values, (), ref, each.origin), each.doc)


def _input(each: FitnessInput, fitness: Fitness, system: System) -> Element:
    measured: Value = ()
    if each.measure is not None and fitness.subject is not None:
        parts = sentences.measure(each.measure)
        measured = _says(parts, each.measure.each, fitness.subject, system)
    if each.space is not None:
        of = each.space.of
        role = fitness.subject is not None and each.space.quantity != "found"
        named = Ref(role_kind(fitness.subject or ""), of) if role else of
        measured = (f"{each.space.quantity}(", named, ")")
    values = properties(type=type_value(each.type), measure=measured)
    return with_doc(Element("input", (each.name,), values, origin=each.origin), each.doc)


def _says(parts: Iterable[sentences.Part], each: str | None, subject: str, system: System) -> Value:
    """Return a sentence, about each robot of a role or about its subject, as a value."""
    return tuple(value for part in parts for value in _said(part, each, subject, system))


def _said(part: sentences.Part, each: str | None, subject: str, system: System) -> Value:
    match part:
        case str():
            return (part,)
        case sentences.Named("state", name, role):
            return (_state(name, _machines(role or each, subject, system)),)
        case sentences.Named(kind, name):
            return (Ref(kind, name),)
        case sentences.Condition(condition, role):
            machines = _machines(role or each, subject, system)
            return expression_value(condition, machines[0].name if machines else "")
    return expression_value(part)


def _machines(role: str | None, subject: str, system: System) -> list[StateMachine]:
    """Return the machine of a property, or those that a robot of a role runs, its own first."""
    for swarm in system.swarms:
        if swarm.name == subject:
            robots = [each.member for each in swarm.roles if each.name == role]
            return _machines_of([system.members_by_name[name] for name in robots], system)
    known = system.machines_by_name
    return [known[subject]] if subject in known else []


def _machines_of(members: Sequence[Member], system: System) -> list[StateMachine]:
    """Return the machines that members and their parts run, their own first."""
    parts = [part.component for member in members for part in member.parts]
    names = [each.behavior for each in members]
    names += [system.components_by_name[name].behavior for name in parts]
    known = system.machines_by_name
    return [known[name] for name in dict.fromkeys(names) if name is not None and name in known]


def _state(name: str, machines: Iterable[StateMachine]) -> str | Ref:
    """Return the state that a name or a path means."""
    found = {
        Ref(state_kind(machine.name), state.id)
        for machine in machines
        for state in machine.walk()
        if matches(tuple(state.id.split(".")), name.split("."))
    }
    exact = {each for each in found if each.name == name} or found
    return exact.pop() if len(exact) == 1 else name


def _optimization(search: Optimization) -> Element:
    ranges = [
        with_doc(
            Element(
                "range",
                (f"{each.role}.{each.param}",),
                properties(values=_range(each.lower, each.upper), step=expression_value(each.step)),
                origin=each.origin,
            ),
            each.doc,
        )
        for each in search.params
    ]
    ranges += (
        with_doc(
            Element(
                "range",
                (f"number of {each.role}",),
                properties(values=_range(each.lower, each.upper)),
                origin=each.origin,
            ),
            each.doc,
        )
        for each in search.counts
    )
    ranges += (
        with_doc(
            Element("constraint", (Ref("property", each.property),), origin=each.origin), each.doc
        )
        for each in search.constraints
    )
    settings = tuple((name, expression_value(value)) for name, value in search.settings)
    element = Element(
        "optimization", (Ref("swarm", search.swarm),), settings, tuple(ranges), None, search.origin
    )
    return with_doc(element, search.doc, search.docs)


def _range(lower: Expression, upper: Expression) -> Value:
    return (*expression_value(lower), "..", *expression_value(upper))
