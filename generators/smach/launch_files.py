"""Files that start the nodes: launch files, parameters, worlds, the test."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.codegen import OutputFile
from swarmdsl.codegen.xml import Element, document

from ..gazebo.world import World, is_furnished
from .launch import fleet_launch, robot_launch, simulation_launch, test_launch, world_file
from .parameters import node_params, own_params
from .robots import Fleet, Robot
from .view import PackageView


def launch_files(package: PackageView) -> Iterator[OutputFile]:
    """Yield the launch files, parameters and worlds of a package."""
    if not package.robots:
        return
    root, name = package.name, package.name
    for robot in package.robots:
        yield from _robot(robot, package)
    for fleet in package.fleets:
        text = fleet_launch(fleet, name)
        yield OutputFile(f"{root}/launch/{fleet.name}.launch", text, origin=fleet.swarm.origin)
        for team in fleet.teams:
            for file, nodes in team.values.items():
                about = f"Params of {file} in swarm {fleet.swarm.name}, by node."
                text = node_params(nodes, package.header, about)
                path = f"{root}/param/{fleet.name}/{file}.model.yaml"
                yield OutputFile(path, text, origin=team.role.origin)
            for number in range(team.most):
                one = f"{team.role.name}_{number}"
                text = own_params(team.robot, fleet, one)
                path = f"{root}/param/{fleet.name}/{one}.yaml"
                yield OutputFile(
                    path, text, keep=True, owner=team.role.name, origin=team.role.origin
                )
        world = world_file(fleet) if package.simulation else None
        if world is not None:
            path = f"{root}/launch/{fleet.name}_simulation.launch"
            at = fleet.environment.origin if fleet.environment is not None else None
            yield OutputFile(path, simulation_launch(fleet, world, name), origin=fleet.swarm.origin)
            yield OutputFile(f"{root}/world/{world}", _world(fleet), keep=True, origin=at)
    yield OutputFile(f"{root}/test/machines.test", test_launch(package.robots, name))


def _robot(robot: Robot, package: PackageView) -> Iterator[OutputFile]:
    at = robot.member.origin
    root = package.name
    teams = (team for fleet in package.fleets for team in fleet.teams)
    has_values = any(team.values for team in teams if team.robot is robot)
    text = robot_launch(robot, package.name, has_values)
    yield OutputFile(f"{root}/launch/{robot.name}.launch", text, origin=at)
    text = node_params(
        robot.nodes, package.header, f"Params of every {robot.member.name}, by node."
    )
    yield OutputFile(f"{root}/param/{robot.name}.yaml", text, origin=at)
    if robot.bridge is not None:
        path = f"{root}/param/{robot.name}.swarmros.cfg"
        yield OutputFile(path, robot.bridge, origin=at)


def _world(fleet: Fleet) -> str:
    """Return a world to start with (SDF 1.6, Gazebo 11): of the environment, or an empty one."""
    if fleet.environment is not None and is_furnished(fleet.environment):
        return document(World(fleet.environment).sdf("1.6", fleet.name))
    root = Element("sdf", {"version": "1.6"})
    world = root.add("world", {"name": fleet.name})
    for model in ("sun", "ground_plane"):
        world.add("include").add("uri", text=f"model://{model}")
    return document(root)
