"""Model of MuJoCo, made from the layout of a space.

Quadrotors are flat cylinders with a thrust along their axis and three torques. Drives are
cylinders on two wheels, with a ball before and behind them that has no friction. Walls, obstacles,
zones and the edges of the environment are solid.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import groupby
from xml.etree import ElementTree as ET

from swarmdsl.base.records import dataclass
from swarmdsl.execution.space.layout import Body, Layout
from swarmdsl.execution.space.shapes import Edge

GRAVITY = 9.81
WALL = 0.02
"""Half of the thickness of a wall, in metres."""
GROUND = "ground"
_TALLEST = 500.0
"""Height of what has none, in metres."""
_ON_GROUND, _ON_SOLIDS, _ON_BODIES = 1, 2, 4
"""Bits of what a shape can touch."""
_MOST_THRUST = 2.5
"""Greatest thrust of a quadrotor, in multiples of its weight."""


@dataclass(frozen=True)
class Form:
    """Measures of the body of a robot, in metres and kilograms."""

    flies: bool
    radius: float
    mass: float
    half: float
    """Half of the height of its cylinder."""
    bottom: float
    """Height of its centre when it stands on the ground."""
    wheel: float = 0.0
    """Radius of its wheels."""
    track: float = 0.0
    """Distance of its wheels."""

    @property
    def inertia(self) -> tuple[float, float]:
        """Moments of inertia of the cylinder: across its axis, and around it."""
        square = self.radius * self.radius
        across = self.mass * (3 * square + 4 * self.half * self.half) / 12
        return across, self.mass * square / 2


def form_of(body: Body) -> Form:
    """Return the measures of a robot from what a model says of its body."""
    if body.climb > 0:
        half = 0.25 * body.radius
        return Form(True, body.radius, body.mass, half, half)
    wheel = 0.4 * body.radius
    return Form(False, body.radius, body.mass, 0.3 * body.radius, wheel, wheel, 1.5 * body.radius)


def mjcf(layout: Layout, timestep: float) -> str:
    """Return the model of a layout as XML; robots are at the origin, named by their numbers."""
    top = ET.Element("mujoco", model="swarm")
    ET.SubElement(top, "compiler", angle="radian")
    ET.SubElement(
        top,
        "option",
        timestep=repr(timestep),
        gravity=_text(0, 0, -GRAVITY),
        integrator="implicitfast",
    )
    # Stiff contacts: the time in which they push bodies apart, and their damping.
    defaults = ET.SubElement(top, "default")
    ET.SubElement(defaults, "geom", solref=_text(2 * timestep, 1))
    world = ET.SubElement(top, "worldbody")
    ET.SubElement(
        world,
        "geom",
        name=GROUND,
        type="plane",
        size="0 0 1",
        contype=str(_ON_GROUND),
        conaffinity="0",
        rgba="0.85 0.87 0.84 1",
    )
    _edges_of(world, layout)
    _solids(world, layout)
    actuators = ET.SubElement(top, "actuator")
    for number, unit in enumerate(layout.units):
        form = form_of(unit.body)
        (_quadrotor if form.flies else _drive)(world, actuators, number, form)
    return ET.tostring(top, encoding="unicode")


# ---- surroundings


def _edges_of(world: ET.Element, layout: Layout) -> None:
    """Enclose the environment in planes."""
    bounds = layout.bounds()
    if bounds is None or layout.size is None:
        return
    low_x, low_y, high_x, high_y = bounds
    planes = [
        ((low_x, 0.0, 0.0), (1, 0, 0)),
        ((0.0, low_y, 0.0), (0, 1, 0)),
        ((high_x, 0.0, 0.0), (-1, 0, 0)),
        ((0.0, high_y, 0.0), (0, -1, 0)),
    ]
    if len(layout.size) > 2:
        tallest = max((2 * form_of(unit.body).half for unit in layout.units), default=0.0)
        planes.append(((0.0, 0.0, layout.size[2] + tallest + WALL), (0, 0, -1)))
    for place, inwards in planes:
        _solid(world, "plane", place, "0 0 1", zaxis=_text(*inwards), rgba="0 0 0 0")


def _solids(world: ET.Element, layout: Layout) -> None:
    boxes = set(layout.boxes)
    for _, group in groupby(layout.edges, key=lambda edge: edge.shape):
        edges = list(group)
        bounds = _bounds(edges)
        low, high = edges[0].low, min(edges[0].high, _TALLEST)
        colour = "0.45 0.47 0.52 1" if edges[0].opaque else "0.8 0.3 0.25 0.25"
        if len(edges) == 4 and bounds in boxes:
            _box(world, bounds, low, high, colour)
            continue
        for edge in edges:
            _wall(world, edge, colour)
    for each in layout.rounds:
        half = min(each.high, _TALLEST) / 2
        place, size = (each.x, each.y, half), _text(each.radius, half)
        _solid(world, "cylinder", place, size, rgba="0.45 0.47 0.52 1")


def _bounds(edges: Sequence[Edge]) -> tuple[float, float, float, float]:
    xs, ys = [edge.x1 for edge in edges], [edge.y1 for edge in edges]
    return min(xs), min(ys), max(xs), max(ys)


def _box(
    world: ET.Element, bounds: tuple[float, float, float, float], low: float, high: float, rgba: str
) -> None:
    low_x, low_y, high_x, high_y = bounds
    place = (low_x + high_x) / 2, (low_y + high_y) / 2, (low + high) / 2
    size = _text((high_x - low_x) / 2, (high_y - low_y) / 2, (high - low) / 2)
    _solid(world, "box", place, size, rgba=rgba)


def _wall(world: ET.Element, edge: Edge, rgba: str) -> None:
    dx, dy = edge.x2 - edge.x1, edge.y2 - edge.y1
    high = min(edge.high, _TALLEST)
    place = (edge.x1 + edge.x2) / 2, (edge.y1 + edge.y2) / 2, (edge.low + high) / 2
    size = _text(math.hypot(dx, dy) / 2 + WALL, WALL, (high - edge.low) / 2)
    _solid(world, "box", place, size, euler=_text(0, 0, math.atan2(dy, dx)), rgba=rgba)


def _solid(
    world: ET.Element, kind: str, place: tuple[float, float, float], size: str, **more: str
) -> None:
    bits = {"contype": str(_ON_SOLIDS), "conaffinity": "0"}
    ET.SubElement(world, "geom", {"type": kind, "pos": _text(*place), "size": size, **bits, **more})


# ---- robots


def _robot(world: ET.Element, number: int) -> ET.Element:
    body = ET.SubElement(world, "body", name=f"robot {number}")
    ET.SubElement(body, "freejoint", name=f"robot {number}")
    return body


def _quadrotor(world: ET.Element, actuators: ET.Element, number: int, form: Form) -> None:
    body = _robot(world, number)
    ET.SubElement(
        body,
        "geom",
        type="cylinder",
        size=_text(form.radius, form.half),
        mass=repr(form.mass),
        contype=str(_ON_BODIES),
        conaffinity=str(_ON_GROUND | _ON_SOLIDS | _ON_BODIES),
        rgba="0.2 0.45 0.7 1",
    )
    site = f"robot {number}"
    ET.SubElement(body, "site", name=site, size="0.01")
    ET.SubElement(
        actuators,
        "motor",
        name=f"thrust {number}",
        site=site,
        gear="0 0 1 0 0 0",
        ctrllimited="true",
        ctrlrange=_text(0, _MOST_THRUST * form.mass * GRAVITY),
    )
    for axis, gear in (("x", "0 0 0 1 0 0"), ("y", "0 0 0 0 1 0"), ("z", "0 0 0 0 0 1")):
        ET.SubElement(actuators, "motor", name=f"torque {axis} {number}", site=site, gear=gear)


def _drive(world: ET.Element, actuators: ET.Element, number: int, form: Form) -> None:
    body = _robot(world, number)
    ET.SubElement(
        body,
        "geom",
        type="cylinder",
        size=_text(form.radius, form.half),
        mass=repr(0.8 * form.mass),
        contype=str(_ON_BODIES),
        conaffinity=str(_ON_SOLIDS | _ON_BODIES),
        rgba="0.85 0.55 0.2 1",
    )
    ball = 0.2 * form.radius
    for ahead in (-1, 1):
        # A millimetre above the ground: the wheels carry the robot.
        place = _text(ahead * 0.7 * form.radius, 0, ball + 0.001 - form.wheel)
        ET.SubElement(
            body,
            "geom",
            type="sphere",
            size=repr(ball),
            pos=place,
            mass=repr(0.02 * form.mass),
            contype="0",
            conaffinity=str(_ON_GROUND),
            condim="1",
            priority="1",
            rgba="0.2 0.2 0.2 1",
        )
    for side, aside in (("left", 1), ("right", -1)):
        wheel = ET.SubElement(body, "body", pos=_text(0, aside * form.track / 2, 0))
        joint = f"{side} {number}"
        ET.SubElement(wheel, "joint", name=joint, type="hinge", axis="0 1 0")
        ET.SubElement(
            wheel,
            "geom",
            type="cylinder",
            size=_text(form.wheel, 0.05 * form.radius),
            euler=_text(math.pi / 2, 0, 0),
            mass=repr(0.08 * form.mass),
            contype="0",
            conaffinity=str(_ON_GROUND),
            rgba="0.15 0.15 0.15 1",
        )
        reach = form.mass * form.wheel
        ET.SubElement(
            actuators,
            "velocity",
            name=joint,
            joint=joint,
            kv=repr(10 * reach * form.wheel),
            forcelimited="true",
            forcerange=_text(-reach * GRAVITY / 2, reach * GRAVITY / 2),
        )


def _text(*numbers: float) -> str:
    return " ".join(repr(float(each)) for each in numbers)
