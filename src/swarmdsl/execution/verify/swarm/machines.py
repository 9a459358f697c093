"""Machines of robots: what properties ask of them, what they send, and to whom."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from swarmdsl import ir
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.verify.swarm.propositions import facts_of, meaning, roles_of

FactsByRole = Mapping[str, Sequence[ir.Fact | ir.Count]]


def facts_by_role(cast: Iterable[Actor], properties: Iterable[ir.Property]) -> FactsByRole:
    """Return the facts of properties, by the role that they are about."""
    roles = list(dict.fromkeys(actor.robot.role for actor in cast))
    found: dict[str, list[ir.Fact | ir.Count]] = {role: [] for role in roles}
    for property_ in properties:
        for fact in facts_of(property_):
            for role in roles_of(fact, property_) or roles:
                known = found.setdefault(role, [])
                if all(meaning(each) != meaning(fact) for each in known):
                    known.append(fact)
    return found


def conditions(
    cast: Sequence[Actor], facts: FactsByRole
) -> Iterator[tuple[str, ir.Expression, tuple[str, ...]]]:
    """Yield the conditions of facts, with machines that can make them true and their events."""
    for role, about in facts.items():
        for fact in about:
            if isinstance(fact, ir.Fact) and fact.guard is not None:
                events = (fact.name,) if fact.name else ()
                of_robot = not events or ir.reads_values(fact.guard)
                for actor in cast:
                    is_part = actor.name != actor.robot.name
                    if actor.robot.role == role and not (of_robot and is_part):
                        yield actor.machine.name, fact.guard, events


def sends(machines: Iterable[ir.StateMachine]) -> Iterator[ir.Send]:
    """Yield the sends of some machines."""
    for machine in machines:
        for state in machine.walk():
            effects = [*state.entry, *state.exit]
            for transition in state.transitions:
                effects += transition.effects
            yield from (each for each in effects if isinstance(each, ir.Send))


def delays_of(machines: Iterable[ir.StateMachine]) -> Iterator[ir.Expression]:
    """Yield the lengths of all delays of some machines."""
    machines = list(machines)
    yield from (each.delay for each in sends(machines) if each.delay is not None)
    for machine in machines:
        for state in machine.walk():
            for transition in state.transitions:
                for trigger in transition.triggers:
                    if isinstance(trigger, ir.TimeTrigger):
                        yield trigger.delay


def addressed(machines: Iterable[ir.StateMachine]) -> Iterator[str]:
    """Yield the robots that machines name as addressees."""
    for send in sends(machines):
        to = send.to
        if to is not None and to.role and isinstance(to.index, ir.Literal):
            yield f"{to.role}[{to.index.value}]"
