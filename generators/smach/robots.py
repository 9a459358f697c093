"""Robots with nodes, and their swarms."""

from __future__ import annotations

from collections.abc import Collection

from swarmdsl.codegen import Diagnostics, dataclass, snake_case
from swarmdsl.codegen.ros import with_parameters
from swarmdsl.codegen.shared import (
    BehaviorNode,
    behavior_nodes,
    bridge_files,
    bringup_package,
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
    """Robots of one type in a swarm, of which `fewest` are started by default."""

    role: Role
    robot: Robot
    fewest: int
    most: int


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
        nodes = tuple(
            with_parameters(node, 1, TARGET, report)
            for node in behavior_nodes(member, system)
            if node.machine.name in machines
        )
        name = snake_case(member.name)
        if nodes:
            check_wiring(member_wiring(member, system), TARGET, report)
            parts = any(nodes_of[part.component] for part in member.parts)
            bridge = bridges.get(name)
            found.append(Robot(name, member, nodes, bridge, components if parts else None))
    return found


def fleets(system: System, made: Collection[Robot]) -> list[Fleet]:
    """Return the swarms that have robots with nodes."""
    by_member = {robot.member.name: robot for robot in made}
    environments = {environment.name: environment for environment in system.environments}
    found = []
    for swarm in system.swarms:
        teams = tuple(_team(r, by_member[r.member]) for r in swarm.roles if r.member in by_member)
        if teams:
            environment = environments.get(swarm.environment or "")
            found.append(Fleet(snake_case(swarm.name), swarm, teams, environment))
    return found


def _team(role: Role, robot: Robot) -> Team:
    fewest = min(max(role.multiplicity.lower, 1), MOST_ROBOTS)
    upper = role.multiplicity.upper
    return Team(role, robot, fewest, fewest if upper is None else min(upper, MOST_ROBOTS))


def _bridges(system: System) -> dict[str, str]:
    """Return the configurations of swarmros by member; comments in them list unsupported events."""
    report = Diagnostics()
    files = list(bridge_files(system, report))
    notes = "".join(f"# {found.message}\n" for found in report)
    return {file.path.removesuffix(".cfg"): notes + file.text for file in files}
