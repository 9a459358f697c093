"""Plain numbers of a space: its size and shapes, its robots with their devices, and the weather.

Lengths are in metres, angles in radians, energy in joules, power in watts; times of the weather in
nanoseconds, other times in seconds.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.space.shapes import Edge, Round
from swarmdsl.ir import Rain, Targets, Type, Wind
from swarmdsl.ir.space import Area, Point

DEFAULT_STEP = 100 * MILLISECOND
"""Time between two steps of a space, in nanoseconds."""


@dataclass(frozen=True)
class Body:
    """Body of a robot; one that can climb flies."""

    radius: float = 0.2
    mass: float = 1.0
    speed: float = 1.0
    climb: float = 0.0
    turn: float = 2 * math.pi


@dataclass(frozen=True)
class Battery:
    """Energy of a robot, and what it needs: for moving, hovering or idling, and for sensing."""

    capacity: float
    moving: float = 0.0
    hovering: float = 0.0
    sensing: float = 0.0
    idling: float = 0.0


@dataclass(frozen=True)
class Radio:
    """Radio of a robot: `loss` is that at its range, `through` what a wall lets through."""

    range: float
    loss: float = 0.0
    through: float = 1.0


@dataclass(frozen=True)
class Eye:
    """Sensor of a robot for a kind of target, and the topic on which it tells what it sees.

    The angle of `view` is around the direction in which the robot looks.
    """

    kind: str
    range: float
    topic: str | None = None
    type: Type | None = None
    view: float = 2 * math.pi
    miss: float = 0.0
    wrong: float = 0.0
    rate: float = 1.0


@dataclass(frozen=True)
class Gauge:
    """Port on which a robot tells its own state: its battery, its pose, or a range ahead."""

    kind: str
    topic: str
    type: Type


@dataclass(frozen=True)
class Unit:
    """Robot with its body and devices; it starts at a point, in an area, or anywhere."""

    robot: Robot
    body: Body = field(default_factory=Body)
    battery: Battery | None = None
    radio: Radio | None = None
    start: Point | str | None = None
    eyes: tuple[Eye, ...] = ()
    gauges: tuple[Gauge, ...] = ()


@dataclass(frozen=True)
class Layout:
    """Everything of a space that is the same in all runs."""

    units: tuple[Unit, ...]
    size: tuple[float, ...] | None = None
    areas: Mapping[str, Area] = field(default_factory=dict)
    edges: tuple[Edge, ...] = ()
    rounds: tuple[Round, ...] = ()
    boxes: tuple[tuple[float, float, float, float], ...] = ()
    targets: tuple[Targets, ...] = ()
    winds: tuple[Wind, ...] = ()
    rains: tuple[Rain, ...] = ()
    step: int = DEFAULT_STEP

    def bounds(self, area: str | None = None) -> tuple[float, float, float, float] | None:
        """Return the lower and upper corner of an area or of all; None without a size."""
        if area is not None:
            box = self.areas[area].box
            return box.low.x, box.low.y, box.high.x, box.high.y
        return (0.0, 0.0, self.size[0], self.size[1]) if self.size is not None else None
