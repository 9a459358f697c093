"""Launch files of robot types, swarms, simulations and the test."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import PurePosixPath

from swarmdsl.codegen import snake_case
from swarmdsl.codegen.shared import BehaviorNode
from swarmdsl.codegen.xml import Element, document, legal
from swarmdsl.ir import Named

from .robots import Fleet, Robot, Team

_SWITCHES = {
    "introspection": "let smach_viewer look into the machines",
    "bridge": "start the bridge between the robots, swarmros",
    "components": "start the components, connected: needs package ",
}


def robot_launch(robot: Robot, package: str, has_values: bool) -> str:
    """Return the launch file that starts the nodes of one robot in its namespace.

    With `has_values`, it takes a file with the params that a swarm sets.
    """
    root = Element("launch")
    root.comment(robot.member.doc)
    _arg(root, "name", f"{robot.name}_0", "the namespace of the robot")
    _arg(root, "member", "$(arg name)", "the name of the robot in the events that it sends")
    if has_values:
        _arg(root, "values", "", "a YAML file with params that the swarm sets")
    _arg(root, "count", "0", "how many there are in its role; 0: one more than its number")
    _arg(root, "params", "", "a YAML file with params of this robot")
    _switches(root, [robot])
    if robot.components is not None:
        # Before the params of this robot, which can be for components too.
        file = f"$(find {robot.components.package})/launch/{robot.name}.launch"
        include = root.add("include", {"file": file, "if": "$(arg components)"})
        _pass(include, "name", "$(arg name)")
    group = root.add("group", {"ns": "$(arg name)"})
    _load(group, f"$(find {package})/param/{robot.name}.yaml")
    for name in ("values", "params") if has_values else ("params",):
        _load(group, f"$(arg {name})").attributes["if"] = f"$(eval arg('{name}') != '')"
    for node in robot.nodes:
        element = _node(group, package, snake_case(node.machine.name), node.name)
        _param(element, "introspection", "$(arg introspection)")
        _param(element, "member", "$(arg member)")
        _param(element, "self/count", "$(arg count)")
        for name, topic in node.remaps:
            element.add("remap", {"from": name, "to": topic})
    if robot.bridge is not None:
        bridge = _node(group, "swarmros", "bridge", "swarmros")
        bridge.attributes["args"] = f"-C$(find {package})/param/{robot.name}.swarmros.cfg"
        bridge.attributes["if"] = "$(arg bridge)"
    return document(root)


def fleet_launch(fleet: Fleet, package: str) -> str:
    """Return the launch file that starts the robots of a swarm in their namespaces."""
    root = Element("launch")
    root.comment(fleet.swarm.doc)
    _team_args(root, fleet.teams)
    _switches(root, [team.robot for team in fleet.teams])
    for team in fleet.teams:
        root.comment(team.role.doc)
        for number in range(team.most):
            file = f"$(find {package})/launch/{team.robot.name}.launch"
            include = root.add("include", {"file": file})
            if team.most > team.fewest and number >= team.fewest:
                include.attributes["if"] = f"$(eval arg('{_count(team)}') > {number})"
            name = f"{team.role.name}_{number}"
            _pass(include, "name", name)
            _pass(include, "member", f"{team.role.name}[{number}]")
            varies = team.most > team.fewest
            _pass(include, "count", f"$(arg {_count(team)})" if varies else str(team.most))
            folder = f"$(find {package})/param/{fleet.name}"
            values = team.values_of(number)
            if values is not None:
                _pass(include, "values", f"{folder}/{values}.model.yaml")
            _pass(include, "params", f"{folder}/{name}.yaml")
            _pass_switches(include, [team.robot])
    return document(root)


def simulation_launch(fleet: Fleet, world: str, package: str) -> str:
    """Return the launch file that starts Gazebo with the world of a swarm, and the swarm."""
    root = Element("launch")
    _arg(root, "world", f"$(find {package})/world/{world}", "the world to simulate")
    _arg(root, "gui", "true", "whether Gazebo has a window")
    _team_args(root, fleet.teams)
    robots = [team.robot for team in fleet.teams]
    _switches(root, robots)
    file = "$(find gazebo_ros)/launch/empty_world.launch"
    gazebo = root.add("include", {"file": file})
    _pass(gazebo, "world_name", "$(arg world)")
    _pass(gazebo, "gui", "$(arg gui)")
    _pass(gazebo, "use_sim_time", "true")
    file = f"$(find {package})/launch/{fleet.name}.launch"
    swarm = root.add("include", {"file": file})
    for team in fleet.teams:
        if team.most > team.fewest:
            _pass(swarm, _count(team), f"$(arg {_count(team)})")
    _pass_switches(swarm, robots)
    return document(root)


def world_file(fleet: Fleet) -> str | None:
    """Return the name of the world file of a swarm, or None if it has no environment."""
    world = fleet.environment.world if fleet.environment is not None else None
    return PurePosixPath(world).name or None if world else None


def test_launch(robots: Iterable[Robot], package: str) -> str:
    """Return the launch file that tests each machine with the params of a robot."""
    root = Element("launch")
    for robot in robots:
        for node in robot.nodes:
            name = f"{robot.name}_{node.name}"
            test = root.add("test", {"pkg": package, "type": "test_machine.py", "test-name": name})
            _param(test, "machine", snake_case(node.machine.name))
            for name, value in _needed(node):
                _param(test, name, value)
            for given in node.params:
                if isinstance(given.param.type, Named):
                    test.add("rosparam", {"param": given.param.name}, "{}")
    return document(root)


def _needed(node: BehaviorNode) -> list[tuple[str, str]]:
    """Return the required params of a node, 0 where the model has no value for them."""
    needed = [
        given
        for given in node.params
        if given.param.default is None and not isinstance(given.param.type, Named)
    ]
    texts = {given.param.name: legal(str(given.value or 0)) for given in needed}
    return [(name, "0" if "$(" in text else text) for name, text in texts.items()]


def _team_args(root: Element, teams: Iterable[Team]) -> None:
    for team in teams:
        if team.most > team.fewest:
            doc = f"how many, {team.fewest} to {team.most}"
            _arg(root, _count(team), str(team.fewest), doc)


def _count(team: Team) -> str:
    return f"{team.role.name}_count"


def _switches(root: Element, robots: Iterable[Robot]) -> None:
    robots = list(robots)
    components = next((robot.components for robot in robots if robot.components is not None), None)
    for name in _names(robots):
        default, doc = "false", _SWITCHES[name]
        if name == "components" and components is not None:
            default, doc = str(components.unasked).lower(), f"{doc}{components.package}"
        _arg(root, name, default, doc)


def _pass_switches(include: Element, robots: Iterable[Robot]) -> None:
    for name in _names(robots):
        _pass(include, name, f"$(arg {name})")


def _names(robots: Iterable[Robot]) -> list[str]:
    has = {"introspection"}
    for robot in robots:
        has |= {"bridge"} if robot.bridge is not None else set()
        has |= {"components"} if robot.components is not None else set()
    return [name for name in _SWITCHES if name in has]


def _arg(parent: Element, name: str, default: str, doc: str) -> None:
    parent.add("arg", {"name": name, "default": default, "doc": doc})


def _pass(include: Element, name: str, value: str) -> None:
    include.add("arg", {"name": name, "value": value})


def _param(parent: Element, name: str, value: str) -> None:
    parent.add("param", {"name": name, "value": value})


def _load(parent: Element, file: str) -> Element:
    return parent.add("rosparam", {"command": "load", "file": file})


def _node(parent: Element, package: str, type_: str, name: str) -> Element:
    attributes = {"pkg": package, "type": type_, "name": name, "output": "screen"}
    return parent.add("node", attributes)
