"""Addresses of events: the roles that machines name, in the swarms that run them.

A machine knows no swarm, so that several can run it; the roles that it names are those of each.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.linker import machines_of
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    Address,
    IndexUse,
    NameUse,
    Part,
    Role,
    StateMachine,
    Swarm,
    nodes_of,
)


@dataclass(frozen=True)
class NamedRole:
    """Name in an address, and the role of a swarm that it means there; None if there is none."""

    address: Address
    name: str
    span: Span
    swarm: Swarm
    role: Role | None


@dataclass(frozen=True)
class Crew:
    """Roles of a swarm by name, and the machines that its members and their parts run, in order."""

    swarm: Swarm
    roles: Mapping[str, Role]
    machines: Mapping[StateMachine, None]


def crews_of(swarms: Iterable[Swarm]) -> list[Crew]:
    """Return the crews of swarms; they are made once for all machines."""
    return [Crew(swarm, roles_of(swarm), dict.fromkeys(machines_in(swarm))) for swarm in swarms]


def named_roles(machine: StateMachine, crews: Iterable[Crew]) -> Iterator[NamedRole]:
    """Yield the names in the addresses of a machine, for each swarm that runs it."""
    addresses = nodes_of(machine, Address)
    for crew in crews if addresses else ():
        if machine not in crew.machines:
            continue
        for address in addresses:
            if address.named_role is not None:
                name, span = address.named_role
                yield NamedRole(address, name, span, crew.swarm, crew.roles.get(name))


def values_like_roles(machine: StateMachine, crew: Crew) -> Iterator[tuple[NameUse, Role]]:
    """Yield the values that are addresses of a machine, and that a role has the name of."""
    for address in nodes_of(machine, Address):
        tree = address.id.tree
        use = tree.base if isinstance(tree, IndexUse) else tree
        if isinstance(use, NameUse) and use.target is not None and use.name in crew.roles:
            yield use, crew.roles[use.name]


def swarms_of(project: Project) -> list[Swarm]:
    """Return the swarms of a project."""
    return [node for _, node in project.declarations() if isinstance(node, Swarm)]


def roles_of(swarm: Swarm) -> dict[str, Role]:
    """Return the roles of a swarm by name."""
    return {str(item.name): item for item in swarm.items if isinstance(item, Role)}


def machines_in(swarm: Swarm) -> set[StateMachine]:
    """Return the machines that the members of a swarm and their parts run."""
    found: set[StateMachine] = set()
    for role in roles_of(swarm).values():
        member = role.member.target
        if member is None:
            continue
        found.update(machines_of(member))
        for part in all_items(member, Part):
            if part.component.target is not None:
                found.update(machines_of(part.component.target))
    return found
