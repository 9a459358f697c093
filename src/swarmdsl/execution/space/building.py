"""Build the layout of a space from a model and a scenario."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain, pairwise
from typing import Any

from swarmdsl import ir
from swarmdsl.execution.engine import ExecutionError
from swarmdsl.execution.simulate.machines.actors import values
from swarmdsl.execution.simulate.machines.expressions import function_of
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.scenario import Robot, Scenario
from swarmdsl.execution.space.layout import (
    DEFAULT_STEP,
    Battery,
    Body,
    Eye,
    Gauge,
    Layout,
    Radio,
    Unit,
)
from swarmdsl.execution.space.messages import is_of_battery
from swarmdsl.execution.space.shapes import UNBOUNDED, Edge, Round
from swarmdsl.ir import Component, Environment, Member, Named, Point, System

BATTERY, POSE, RANGE = "battery", "pose", "range"
_POSE, _RANGE = Named("geometry_msgs", "PoseStamped"), Named("sensor_msgs", "Range")


class UnfitError(ValueError):
    """A value of a device that cannot be: what it is of, and why."""

    def __init__(self, owner: str, name: str, reason: str) -> None:
        super().__init__(f"`{name}` of {owner} {reason}")
        self.owner = owner
        self.name = name
        self.reason = reason


def build(subject: Subject, robots: Sequence[Robot], scenario: Scenario) -> Layout:
    """Return the layout of a swarm, or of a machine alone.

    Raises UnfitError for a value that cannot be.
    """
    units = tuple(_unit(subject, robot, scenario) for robot in robots)
    step = scenario.step or DEFAULT_STEP
    environment = subject.environment
    if environment is None:
        return Layout(units, step=step)
    edges, rounds, boxes = _shapes(environment)
    return Layout(
        units,
        environment.size,
        {each.name: each for each in environment.areas},
        tuple(edges),
        tuple(rounds),
        tuple(boxes),
        environment.targets,
        environment.winds,
        environment.rains,
        step,
    )


Bounds = tuple[float, float, float, float]


def _shapes(environment: Environment) -> tuple[list[Edge], list[Round], list[Bounds]]:
    edges: list[Edge] = []
    rounds: list[Round] = []
    boxes: list[Bounds] = []
    shape = 0
    for wall in environment.walls:
        high = UNBOUNDED if wall.height is None else wall.height
        edges += _line(wall.points, 0.0, high, shape, opaque=True)
        shape += 1
    solid: list[tuple[ir.Box, bool]] = [(zone.box, False) for zone in environment.zones]
    for obstacle in environment.obstacles:
        match obstacle.shape:
            case ir.Disc(centre=centre, radius=radius, height=height):
                high = UNBOUNDED if height is None else height
                rounds.append(Round(centre.x, centre.y, radius, high))
            case box:
                solid.append((box, True))
    for box, opaque in solid:
        high = UNBOUNDED if box.highest is None else box.highest
        low_x, low_y, high_x, high_y = box.low.x, box.low.y, box.high.x, box.high.y
        corners = [Point(low_x, low_y), Point(high_x, low_y)]
        corners += [Point(high_x, high_y), Point(low_x, high_y), Point(low_x, low_y)]
        edges += _line(corners, box.lowest, high, shape, opaque=opaque)
        boxes.append((low_x, low_y, high_x, high_y))
        shape += 1
    return edges, rounds, boxes


def _line(
    points: Sequence[Point], low: float, high: float, shape: int, *, opaque: bool
) -> Iterator[Edge]:
    for one, other in pairwise(points):
        yield Edge(one.x, one.y, other.x, other.y, low, high, opaque, shape)


# ---- robots


def _unit(subject: Subject, robot: Robot, scenario: Scenario) -> Unit:
    system, swarm = subject.system, subject.swarm
    if system is None or swarm is None:
        return Unit(robot)
    member = subject.member(robot)
    role = next(each for each in swarm.roles if each.name == robot.role)
    own = next((each.start for each in role.robots if each.index == robot.index), None)
    data = values(subject, robot, None, scenario)
    owner = f"member `{member.name}`"
    body, battery, radio = (
        _evaluated(each, data, f"the {word} of {owner}")
        for each, word in (
            (member.body, "body"),
            (member.battery, "battery"),
            (member.radio, "radio"),
        )
    )
    return Unit(
        robot,
        Body(**body),
        Battery(**battery) if battery.get("capacity") is not None else None,
        Radio(**radio) if radio.get("range") is not None else None,
        own if own is not None else role.start,
        tuple(_eyes(subject, member, robot, scenario)),
        tuple(dict.fromkeys(_gauges(member, system, has_battery=bool(battery)))),
    )


def _evaluated(
    given: Iterable[tuple[str, ir.Expression]], data: Mapping[str, Any], owner: str
) -> dict[str, float]:
    found = {}
    for name, expression in given:
        try:
            value = float(function_of(expression)(data, None))
        except (ArithmeticError, ValueError, KeyError, ExecutionError) as error:
            raise UnfitError(owner, name, f"has no value: {error}") from error
        if not math.isfinite(value) or value < 0:
            raise UnfitError(owner, name, f"is {value:g}: it must be a number from 0 on")
        if name in ("miss", "wrong", "loss", "through") and value > 1:
            raise UnfitError(owner, name, f"is {value:g}: it must be a probability")
        found[name] = value
    return found


def _eyes(subject: Subject, member: Member, robot: Robot, scenario: Scenario) -> Iterator[Eye]:
    system = subject.system
    assert system is not None
    for part in member.parts:
        component = system.components_by_name[part.component]
        if not component.sights:
            continue
        data = values(subject, robot, part, scenario)
        port = next(_said(component), None)
        topic = _topic(member, part.name, port) if port is not None else None
        for sight in component.sights:
            owner = f"`senses {sight.kind}` of {component.kind} `{component.name}`"
            given = _evaluated(sight.values, data, owner)
            reach = given.pop("range", math.inf)
            yield Eye(sight.kind, reach, topic, port.type if port else None, **given)


def _gauges(member: Member, system: System, *, has_battery: bool) -> Iterator[Gauge]:
    """Yield the ports on which a robot tells its own state."""
    for part in member.parts:
        component = system.components_by_name[part.component]
        ports = list(_said(component)) if component.kind == "sensor" else []
        for port in ports[1:] if component.sights else ports:
            topic = _topic(member, part.name, port)
            if is_of_battery(port.type, system) and has_battery:
                yield Gauge(BATTERY, topic, port.type)
            elif port.type == _POSE:
                yield Gauge(POSE, topic, port.type)
            elif port.type == _RANGE:
                yield Gauge(RANGE, topic, port.type)
    for event in system.events if has_battery else ():
        if not event.swarm and not event.predefined and is_of_battery(event.type, system):
            yield Gauge(BATTERY, event.incoming_topic, event.type)


def _said(component: Component) -> Iterator[ir.Port]:
    """Yield the ports on which a component tells something."""
    return (port for port in component.ports if port.direction != "in")


def _topic(member: Member, part: str, port: ir.Port) -> str:
    """Return the topic of a port, which connectors can change."""
    groups = chain.from_iterable(
        ((ref, group.topic) for ref in group.ports) for group in member.port_groups
    )
    return next((t for ref, t in groups if (ref.part, ref.port) == (part, port.name)), port.topic)
