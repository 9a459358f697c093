"""The members that are robots with nodes, and the swarms that they are in."""

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

# As many robots as one launch file starts.
MOST_ROBOTS = 100


@dataclass(frozen=True)
class Components:
    """The package that starts the nodes of components, and whether launch files do so unasked."""

    package: str
    unasked: bool


@dataclass(frozen=True)
class Robot:
    """A type of robot with its nodes; `bridge` is the configuration of swarmros for it.

    `components` is None where no part needs a node besides that of its behaviour.
    """

    name: str
    member: Member
    nodes: tuple[BehaviorNode, ...]
    bridge: str | None
    components: Components | None


@dataclass(frozen=True)
class Team:
    """Robots of one type in a swarm: `fewest` are started where nothing else is said."""

    role: Role
    robot: Robot
    fewest: int
    most: int


@dataclass(frozen=True)
class Fleet:
    """A swarm as it is launched."""

    name: str
    swarm: Swarm
    teams: tuple[Team, ...]
    environment: Environment | None


def robots(
    system: System, machines: Collection[str], unasked: bool, report: Diagnostics
) -> list[Robot]:
    """The members that run one of these machines, with their components started `unasked`."""
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
    """The swarms with robots that have nodes."""
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
    """The configurations of swarmros; what cannot cross the bridge is said in a comment."""
    report = Diagnostics()
    files = list(bridge_files(system, report))
    notes = "".join(f"# {found.message}\n" for found in report)
    return {file.path.removesuffix(".cfg"): notes + file.text for file in files}
