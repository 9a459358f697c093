"""What is launched of a swarm: for each role its members, for each member its nodes."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping

from swarmdsl.codegen import Diagnostics, Span, dataclass, fresh, snake_case
from swarmdsl.codegen.shared import (
    Remaps,
    Value,
    behavior_nodes,
    bringup_package,
    check_wiring,
    has_node,
    member_wiring,
)
from swarmdsl.ir import Member, Role, Swarm, System

from .names import TARGET
from .params import given


@dataclass(frozen=True)
class LaunchedNode:
    """A node of a member: that of its own behaviour, or of a part of it."""

    executable: str
    name: str
    part: str | None
    values: Mapping[str, Value]
    remaps: Remaps = ()


@dataclass(frozen=True)
class LaunchedRole:
    """A role of the swarm; `least` members are launched if nothing else is said.

    `components` is the launch file, in another package, of the nodes of its components.
    """

    name: str
    member: str
    least: int
    lower: int
    upper: int | None
    nodes: tuple[LaunchedNode, ...]
    components: str | None


@dataclass(frozen=True)
class Launch:
    """A launch file: that of a swarm."""

    name: str
    swarm: str
    doc: str
    roles: tuple[LaunchedRole, ...]
    bringup: str
    origin: Span | None

    @property
    def has_components(self) -> bool:
        """Whether components need nodes besides those of behaviours."""
        return any(role.components is not None for role in self.roles)

    @property
    def has_remaps(self) -> bool:
        """Whether a node is to find topics under other names."""
        return any(node.remaps for role in self.roles for node in role.nodes)


def launches(system: System, modules: Mapping[str, str], report: Diagnostics) -> list[Launch]:
    """The launch files; there is none for a swarm in which nobody has a behaviour."""
    found: list[Launch] = []
    for swarm in system.swarms:
        roles = tuple(role for role in _roles(swarm, system, modules, report) if role.nodes)
        if roles:
            name = fresh(snake_case(swarm.name) or "swarm", (each.name for each in found))
            bringup = bringup_package(system)
            found.append(Launch(name, swarm.name, swarm.doc, roles, bringup, swarm.origin))
    launched = {role.member for launch in found for role in launch.roles}
    for member in system.members:
        if member.name in launched:
            check_wiring(member_wiring(member, system), TARGET, report)
    return found


def _roles(
    swarm: Swarm, system: System, modules: Mapping[str, str], report: Diagnostics
) -> Iterator[LaunchedRole]:
    components = {component.name: component for component in system.components}
    for role in swarm.roles:
        member = next(each for each in system.members if each.name == role.member)
        parts = any(has_node(components[part.component]) for part in member.parts)
        yield LaunchedRole(
            role.name,
            member.name,
            max(role.multiplicity.lower, 1),
            role.multiplicity.lower,
            role.multiplicity.upper,
            tuple(_nodes(member, system, modules, report)),
            f"{snake_case(member.name)}.launch.py" if parts else None,
        )


def _nodes(
    member: Member, system: System, modules: Mapping[str, str], report: Diagnostics
) -> Iterator[LaunchedNode]:
    for node in behavior_nodes(member, system):
        module = modules[node.machine.name]
        name = node.name if node.part is not None else module
        yield LaunchedNode(module, name, node.part, given(node, report), node.remaps)


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
