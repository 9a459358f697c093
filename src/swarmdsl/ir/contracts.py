"""Contracts of members as properties."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.ir.architecture import Contract, Member, Swarm
from swarmdsl.ir.properties import Claim, Fact, Junction, Property


def promised(
    members: Sequence[Member], swarms: Sequence[Swarm], properties: Sequence[Property]
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
        if not places and member.behavior is not None:
            places.append((member.behavior, None))
        for contract in contracts:
            for subject, role in places:
                name = f"{role or member.name}_{contract.name}"
                if name in taken:
                    name = f"{subject}_{name}"
                taken.add(name)
                found.append(_property(contract, name, subject, role))
    return tuple(found)


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
