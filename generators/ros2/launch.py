"""Launch files of swarms: the members of each role, and the nodes of each member."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from swarmdsl.codegen import Diagnostics, Span, dataclass, fresh, snake_case
from swarmdsl.codegen.ros import yaml_key, yaml_value
from swarmdsl.codegen.shared import (
    Remaps,
    Value,
    behavior_nodes,
    bringup_package,
    check_part_values,
    check_wiring,
    has_node,
    member_functions,
    member_wiring,
)
from swarmdsl.ir import Member, Role, StateMachine, Swarm, System

from .command_topics import check_command_topics
from .names import TARGET
from .package import called_functions
from .params import given
from .served import OFFBOARD, is_served

_ROBOT = "robot"
"""Launch file of one robot."""
_SECOND = 1_000_000_000


@dataclass(frozen=True)
class Watchdog:
    """Server that is called when a node has died; goals of the actions `cancels` end before."""

    function: str
    paradigm: str
    type: str
    cancels: tuple[str, ...]


@dataclass(frozen=True)
class LaunchedNode:
    """A node of a member, for its own behaviour or the behaviour of a part."""

    executable: str
    name: str
    part: str | None
    values: Mapping[str, Value]
    remaps: Remaps = ()
    watchdog: Watchdog | None = None


@dataclass(frozen=True)
class LaunchedRole:
    """A role of the swarm, of which `least` members are launched by default.

    `bringup` is the launch file of the nodes of its functions and components, in another package;
    `servers` are the executables of functions of this one.
    `robots` are the nodes of members with values of their own, by index.
    """

    name: str
    member: str
    least: int
    lower: int
    upper: int | None
    nodes: tuple[LaunchedNode, ...]
    bringup: str | None
    robots: Mapping[int, tuple[LaunchedNode, ...]]
    servers: tuple[str, ...] = ()


@dataclass(frozen=True)
class Launch:
    """The launch file of a swarm."""

    name: str
    swarm: str
    doc: str
    roles: tuple[LaunchedRole, ...]
    bringup: str
    heartbeat: tuple[float, float] | None
    origin: Span | None

    @property
    def has_bringup(self) -> bool:
        """True if functions or components need nodes of their own."""
        return any(role.bringup is not None for role in self.roles)


def launches(system: System, modules: Mapping[str, str], report: Diagnostics) -> list[Launch]:
    """Return the launch files of all swarms in which a member has a behaviour."""
    found: list[Launch] = []
    for swarm in system.swarms:
        roles = tuple(role for role in _roles(swarm, system, modules, report) if role.nodes)
        if roles:
            taken = (_ROBOT, *(each.name for each in found))
            name = fresh(snake_case(swarm.name) or "swarm", taken)
            bringup = bringup_package(system)
            found.append(
                Launch(
                    name,
                    swarm.name,
                    swarm.doc,
                    roles,
                    bringup,
                    _heartbeat(swarm),
                    swarm.origin,
                )
            )
    launched = {role.member for launch in found for role in launch.roles}
    for member in system.members:
        if member.name in launched:
            check_wiring(member_wiring(member, system), TARGET, report)
            check_command_topics(member, system, report)
    return found


def _heartbeat(swarm: Swarm) -> tuple[float, float] | None:
    """Return the times of a heartbeat in seconds."""
    beat = swarm.heartbeat
    return (beat.period / _SECOND, beat.timeout / _SECOND) if beat is not None else None


def _roles(
    swarm: Swarm, system: System, modules: Mapping[str, str], report: Diagnostics
) -> Iterator[LaunchedRole]:
    components = system.components_by_name
    for role in swarm.roles:
        member = system.members_by_name[role.member]
        needed = any(has_node(components[part.component]) for part in member.parts)
        needed = needed or bool(member_functions(member, system))
        check_part_values(role, member, system, TARGET, report)
        yield LaunchedRole(
            role.name,
            member.name,
            max(role.multiplicity.lower, 1),
            role.multiplicity.lower,
            role.multiplicity.upper,
            tuple(_nodes(role.configured(member), system, modules, report)),
            f"{snake_case(member.name)}.launch.py" if needed else None,
            {
                robot.index: tuple(
                    _nodes(role.configured(member, robot.index), system, modules, report)
                )
                for robot in role.robots
            },
            _servers(member, system),
        )


def _nodes(
    member: Member, system: System, modules: Mapping[str, str], report: Diagnostics
) -> Iterator[LaunchedNode]:
    for node in behavior_nodes(member, system):
        module = modules[node.machine.name]
        name = node.name if node.part is not None else module
        watchdog = _watchdog(member, node.machine, system) if node.part is None else None
        yield LaunchedNode(module, name, node.part, given(node, report), node.remaps, watchdog)


def _servers(member: Member, system: System) -> tuple[str, ...]:
    called = [each.function for each in member.contracts if each.function is not None]
    for node in behavior_nodes(member, system):
        called += called_functions(node.machine)
    return (OFFBOARD,) if any(is_served(system.function(name)) for name in called) else ()


def _watchdog(member: Member, machine: StateMachine, system: System) -> Watchdog | None:
    """Return what is called when the node of a member dies, as its contracts say."""
    called = [each.function for each in member.contracts if each.function is not None]
    if not called:
        return None
    server = system.function(called[0]).communication
    kind = "action" if server.paradigm == "action" else "srv"
    used = [system.function(name).communication for name in called_functions(machine)]
    return Watchdog(
        server.name,
        server.paradigm,
        f"{server.type.package}/{kind}/{server.type.name}",
        tuple(each.name for each in used if each.paradigm == "action"),
    )


def configuration(nodes: Iterable[LaunchedNode], head: Iterable[str]) -> str:
    """Return the parameters of the nodes of a role or of a robot, as YAML."""
    lines = [f"# {line}".rstrip() for line in head]
    for node in nodes:
        lines += [f"/**/{node.name}:", "  ros__parameters:"]
        lines += [
            f"    {yaml_key(name)}: {yaml_value(value)}" for name, value in node.values.items()
        ]
        if not node.values:
            lines[-1] += " {}"
    return "".join(f"{line}\n" for line in lines)


__all__ = ["Launch", "LaunchedNode", "LaunchedRole", "Role", "configuration", "launches"]
