"""Robots with nodes, and their swarms."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from swarmdsl.codegen import Diagnostics, dataclass, snake_case
from swarmdsl.codegen.ros import with_parameters
from swarmdsl.codegen.shared import (
    BehaviorNode,
    behavior_nodes,
    bridge_files,
    bringup_package,
    check_part_values,
    check_wiring,
    has_node,
    member_wiring,
)
from swarmdsl.ir import Environment, Member, Role, Swarm, System

from .module import TARGET

# Limit for the robots that one launch file starts.
MOST_ROBOTS = 100


@dataclass(frozen=True)
class Components:
    """The package that starts components; launch files do so by default if `unasked`."""

    package: str
    unasked: bool


@dataclass(frozen=True)
class Robot:
    """A robot type with its nodes; `bridge` is its configuration of swarmros.

    `components` is None if no part needs a node other than for its behaviour.
    """

    name: str
    member: Member
    nodes: tuple[BehaviorNode, ...]
    bridge: str | None
    components: Components | None


@dataclass(frozen=True)
class Team:
    """Robots of one type in a swarm, of which `fewest` are started by default.

    `values` are the nodes with the params that the role sets, by the names of files: `uav` for all
    of them, `uav_1` for a robot with values of its own.
    """

    role: Role
    robot: Robot
    fewest: int
    most: int
    values: Mapping[str, tuple[BehaviorNode, ...]]

    def values_of(self, number: int) -> str | None:
        """Return the name of the file with the values of a robot; None if there are none."""
        names = (f"{self.role.name}_{number}", self.role.name)
        return next((name for name in names if name in self.values), None)


@dataclass(frozen=True)
class Fleet:
    """A swarm with its teams, for launch files."""

    name: str
    swarm: Swarm
    teams: tuple[Team, ...]
    environment: Environment | None


def robots(
    system: System, machines: Collection[str], unasked: bool, report: Diagnostics
) -> list[Robot]:
    """Return the robots that run one of these machines; `unasked` is for their components."""
    bridges = _bridges(system)
    nodes_of = {component.name: has_node(component) for component in system.components}
    components = Components(bringup_package(system), unasked)
    found = []
    for member in system.members:
        nodes = _nodes(member, system, machines, report)
        name = snake_case(member.name)
        if nodes:
            check_wiring(member_wiring(member, system), TARGET, report)
            parts = any(nodes_of[part.component] for part in member.parts)
            bridge = bridges.get(name)
            found.append(Robot(name, member, nodes, bridge, components if parts else None))
    return found


def fleets(system: System, made: Collection[Robot], report: Diagnostics) -> list[Fleet]:
    """Return the swarms that have robots with nodes."""
    by_member = {robot.member.name: robot for robot in made}
    environments = {environment.name: environment for environment in system.environments}
    found = []
    for swarm in system.swarms:
        teams = tuple(
            _team(role, by_member[role.member], system, report)
            for role in swarm.roles
            if role.member in by_member
        )
        if teams:
            environment = environments.get(swarm.environment or "")
            found.append(Fleet(snake_case(swarm.name), swarm, teams, environment))
    return found


def _team(role: Role, robot: Robot, system: System, report: Diagnostics) -> Team:
    fewest = min(max(role.multiplicity.lower, 1), MOST_ROBOTS)
    upper = role.multiplicity.upper
    most = fewest if upper is None else min(upper, MOST_ROBOTS)
    check_part_values(role, robot.member, system, TARGET, report)
    return Team(role, robot, fewest, most, dict(_values(role, robot, system, report)))


def _values(
    role: Role, robot: Robot, system: System, report: Diagnostics
) -> Iterator[tuple[str, tuple[BehaviorNode, ...]]]:
    machines = {node.machine.name for node in robot.nodes}
    indexes = [each.index for each in role.robots]
    for index in [*([None] if role.values else []), *indexes]:
        member = role.configured(robot.member, index)
        name = role.name if index is None else f"{role.name}_{index}"
        yield name, _nodes(member, system, machines, report)


def _nodes(
    member: Member, system: System, machines: Collection[str], report: Diagnostics
) -> tuple[BehaviorNode, ...]:
    return tuple(
        with_parameters(node, 1, TARGET, report)
        for node in behavior_nodes(member, system)
        if node.machine.name in machines
    )


def _bridges(system: System) -> dict[str, str]:
    """Return the configurations of swarmros by member; comments in them list unsupported events."""
    report = Diagnostics()
    files = list(bridge_files(system, report))
    notes = "".join(f"# {found.message}\n" for found in report)
    return {file.path.removesuffix(".cfg"): notes + file.text for file in files}
