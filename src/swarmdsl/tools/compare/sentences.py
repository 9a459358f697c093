"""Properties and other sentences about robots as elements and values."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from swarmdsl.analysis.resolve.sentences import matches
from swarmdsl.ir import Member, Property, StateMachine, System, sentences
from swarmdsl.ir.sentences import sentence
from swarmdsl.tools.compare.elements import (
    Element,
    Ref,
    Value,
    expression_value,
    properties,
    reference,
    state_kind,
    with_doc,
)


def property_element(each: Property, system: System) -> Element:
    """Return a property with its sentence."""
    kind = "statemachine" if each.subject in system.machines_by_name else "swarm"
    says = sentence_value(sentence(each), each.each, each.subject, system)
    values = properties(about=reference(each.subject, kind), says=says)
    ref = Ref("property", each.name)
    return with_doc(Element("property", (each.name,), values, (), ref, each.origin), each.doc)


def sentence_value(
    parts: Iterable[sentences.Part], each: str | None, subject: str, system: System
) -> Value:
    """Return a sentence, about each robot of a role or about its subject, as a value."""
    return tuple(value for part in parts for value in _said(part, each, subject, system))


def _said(part: sentences.Part, each: str | None, subject: str, system: System) -> Value:
    match part:
        case str():
            return (part,)
        case sentences.Named("state", name, role):
            return (state_value(name, _machines(role or each, subject, system)),)
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
            return machines_of([system.members_by_name[name] for name in robots], system)
    known = system.machines_by_name
    return [known[subject]] if subject in known else []


def machines_of(members: Sequence[Member], system: System) -> list[StateMachine]:
    """Return the machines that members and their parts run, their own first."""
    parts = [part.component for member in members for part in member.parts]
    names = [each.behavior for each in members]
    names += [system.components_by_name[name].behavior for name in parts]
    known = system.machines_by_name
    return [known[name] for name in dict.fromkeys(names) if name is not None and name in known]


def state_value(name: str, machines: Iterable[StateMachine]) -> str | Ref:
    """Return the state that a name or a path means."""
    found = {
        Ref(state_kind(machine.name), state.id)
        for machine in machines
        for state in machine.walk()
        if matches(tuple(state.id.split(".")), name.split("."))
    }
    exact = {each for each in found if each.name == name} or found
    return exact.pop() if len(exact) == 1 else name
