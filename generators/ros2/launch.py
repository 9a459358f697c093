"""What is launched of a swarm: for each role its members, for each member its nodes."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping

from swarmdsl.dataclass import dataclass
from swarmdsl.exchange.constants import Value
from swarmdsl.ir import Component, Member, Part, Role, StateMachine, Swarm, System
from swarmdsl.naming import fresh, snake_case
from swarmdsl.source import Span

from .params import given


@dataclass(frozen=True)
class LaunchedNode:
    """A node of a member: that of its own behaviour, or of a part of it."""

    executable: str
    name: str
    part: str | None
    values: Mapping[str, Value]


@dataclass(frozen=True)
class LaunchedRole:
    """A role of the swarm; `least` members are launched if nothing else is said."""

    name: str
    member: str
    least: int
    lower: int
    upper: int | None
    nodes: tuple[LaunchedNode, ...]


@dataclass(frozen=True)
class Launch:
    """A launch file: that of a swarm."""

    name: str
    swarm: str
    doc: str
    roles: tuple[LaunchedRole, ...]
    origin: Span | None


def launches(system: System, modules: Mapping[str, str]) -> list[Launch]:
    """The launch files; there is none for a swarm in which nobody has a behaviour."""
    found: list[Launch] = []
    for swarm in system.swarms:
        roles = tuple(role for role in _roles(swarm, system, modules) if role.nodes)
        if roles:
            name = fresh(snake_case(swarm.name) or "swarm", (each.name for each in found))
            found.append(Launch(name, swarm.name, swarm.doc, roles, swarm.origin))
    return found


def _roles(swarm: Swarm, system: System, modules: Mapping[str, str]) -> Iterator[LaunchedRole]:
    for role in swarm.roles:
        member = next(each for each in system.members if each.name == role.member)
        yield LaunchedRole(
            role.name,
            member.name,
            max(role.multiplicity.lower, 1),
            role.multiplicity.lower,
            role.multiplicity.upper,
            tuple(_nodes(member, system, modules)),
        )


def _nodes(member: Member, system: System, modules: Mapping[str, str]) -> Iterator[LaunchedNode]:
    machines = {machine.name: machine for machine in system.machines}
    components = {component.name: component for component in system.components}
    if member.behavior is not None:
        machine = machines[member.behavior]
        yield _node(machine, modules[machine.name], member, None, modules)
    for part in member.parts:
        component = components[part.component]
        if component.behavior is not None:
            yield _node(machines[component.behavior], part.name, component, part, modules)


def _node(
    machine: StateMachine,
    name: str,
    owner: Member | Component,
    part: Part | None,
    modules: Mapping[str, str],
) -> LaunchedNode:
    return LaunchedNode(
        modules[machine.name],
        name,
        part.name if part is not None else None,
        given(machine, owner, part),
    )


def configuration(role: LaunchedRole, head: Iterable[str]) -> str:
    """The parameters of the nodes of a role, as YAML."""
    lines = [f"# {line}".rstrip() for line in head]
    for node in role.nodes:
        lines += [f"/**/{node.name}:", "  ros__parameters:"]
        lines += [f"    {name}: {json.dumps(value)}" for name, value in node.values.items()]
        if not node.values:
            lines[-1] += " {}"
    return "".join(f"{line}\n" for line in lines)


__all__ = ["Launch", "LaunchedNode", "LaunchedRole", "Role", "configuration", "launches"]
