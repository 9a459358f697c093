"""Conditions of properties and measures that robots tell their monitors."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.codegen.shared import condition_text, envelopes_of, facts_of, reads_envelope
from swarmdsl.ir import (
    Count,
    Expression,
    Fact,
    Fitness,
    FitnessInput,
    ParamRef,
    StateMachine,
    System,
    reads_values,
    subexpressions,
)


def conditions(machine: StateMachine, system: System) -> dict[str, Fact]:
    """Return the facts with conditions that robots with a machine tell, by their text.

    A machine of a part tells only conditions on messages alone: variables are those of the robot.
    """
    found: list[Fact] = []
    for swarm in system.swarms:
        members = {role.name: system.members_by_name[role.member] for role in swarm.roles}
        own = {name for name, member in members.items() if member.behavior == machine.name}
        parts = {
            name
            for name, member in members.items()
            for part in member.parts
            if system.components_by_name[part.component].behavior == machine.name
        }
        for each, fact in _facts_about(swarm.name, system):
            if isinstance(fact, Fact) and fact.guard is not None:
                of_message = fact.act != "has" and not reads_values(fact.guard)
                roles = own | parts if of_message else own
                role = fact.robots.role if fact.robots is not None else each
                if role in roles or (fact.act == "arrives" and roles):
                    found.append(fact)
    found += [
        fact
        for property_ in system.judged
        if property_.subject == machine.name
        for fact in facts_of(property_)
        if isinstance(fact, Fact)
    ]
    return {
        told_text(fact): fact
        for fact in found
        if fact.guard is not None
        and unknown_param(fact.guard, machine) is None
        and not needs_sender(fact, system)
    }


def told_text(fact: Fact) -> str:
    """Return what nodes call a condition: `load > 3`, `hears Take [event.data > 3]`."""
    assert fact.guard is not None
    text = condition_text(fact.guard)
    return text if fact.act == "has" else f"{heard_or_sent(fact)} {fact.name} [{text}]"


def heard_or_sent(fact: Fact) -> str:
    """Return the act by which a node knows the message of an event."""
    return "sends" if fact.act == "sends" else "hears"


def _facts_about(swarm: str, system: System) -> Iterator[tuple[str | None, Fact | Count]]:
    """Yield the facts in properties and measures of a swarm, each with the role of `each`."""
    for property_ in system.judged:
        if property_.subject == swarm:
            for fact in facts_of(property_):
                yield property_.each, fact
    fitness = fitness_of(swarm, system)
    for input_ in fitness.inputs if fitness is not None else ():
        if input_.measure is not None:
            for fact in facts_of_input(input_):
                yield input_.measure.each, fact


def facts_of_input(input_: FitnessInput) -> Iterable[Fact | Count]:
    """Return the facts in the measure of an input."""
    return facts_of(input_.measure) if input_.measure is not None else ()


def fitness_of(swarm: str, system: System) -> Fitness | None:
    """Return the fitness of a swarm."""
    (name,) = (each.fitness for each in system.swarms if each.name == swarm)
    return next((each for each in system.fitness if each.name == name), None)


def unknown_param(condition: Expression, machine: StateMachine | None) -> str | None:
    """Return a param of the robot that its machine does not have, or None."""
    known = {param.name for param in machine.params} if machine is not None else set()
    for part in subexpressions(condition):
        if isinstance(part, ParamRef) and part.name not in known:
            return part.name
    return None


def needs_sender(fact: Fact, system: System) -> bool:
    """Return True if a condition asks who sent an event, or when, and its message does not tell."""
    return (
        fact.guard is not None
        and reads_envelope([fact.guard])
        and fact.name not in envelopes_of(system)
    )
