"""Contracts of members as properties."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from swarmdsl.base.naming import fresh
from swarmdsl.ir.architecture import Contract, Member, Swarm
from swarmdsl.ir.expressions import ParamRef, subexpressions
from swarmdsl.ir.properties import Claim, Fact, Junction, Property
from swarmdsl.ir.statemachine import StateMachine


def promised(
    members: Sequence[Member],
    swarms: Sequence[Swarm],
    properties: Sequence[Property],
    machines: Mapping[str, StateMachine],
) -> tuple[Property, ...]:
    """Return what contracts promise, as properties: one for each role, or for a machine alone.

    `contract Abort : on Halt within 2 s reach Landed` of the robots of role `uav` is the property
    `uav_Abort`: `each uav : hears Halt leads to in Landed within 2 s`.
    """
    found: list[Property] = []
    taken = {each.name for each in properties}
    for member in members:
        contracts = [each for each in member.contracts if each.function is None]
        roles = [(swarm, role) for swarm in swarms for role in swarm.roles]
        places: list[tuple[str, str | None]] = [
            (swarm.name, role.name) for swarm, role in roles if role.member == member.name
        ]
        alone = machines.get(member.behavior or "") if not places else None
        for contract in contracts:
            is_about = alone is not None and _is_about(contract, alone)
            for subject, role in [(alone.name, None)] if alone is not None and is_about else places:
                name = f"{role or member.name}_{contract.name}"
                name = fresh(f"{subject}_{name}" if name in taken else name, taken)
                taken.add(name)
                found.append(_property(contract, name, subject, role))
    return tuple(found)


def _is_about(contract: Contract, machine: StateMachine) -> bool:
    """Return True if a machine has the states of a contract, and the params in its guard."""
    ends = {state.id.rpartition(".")[2] for state in machine.walk()}
    given = {each.name for each in machine.params}
    values = [each for each in (contract.guard, contract.within) if each is not None]
    read = (part for value in values for part in subexpressions(value))
    return all(each.rpartition(".")[2] in ends for each in contract.states) and all(
        each.name in given for each in read if isinstance(each, ParamRef)
    )


def _property(contract: Contract, name: str, subject: str, role: str | None) -> Property:
    guard, at = contract.guard, contract.origin
    heard = [Fact("hears", each, None, guard, origin=at) for each in contract.events]
    reached = [Fact("in", each, origin=at) for each in contract.states]
    return Property(
        name,
        subject,
        "leads",
        (_any(heard), _any(reached)),
        role,
        within=contract.within,
        doc=contract.doc,
        origin=at,
    )


def _any(facts: Sequence[Fact]) -> Claim:
    return facts[0] if len(facts) == 1 else Junction("or", tuple(facts))
