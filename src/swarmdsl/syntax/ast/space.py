"""Nodes of space.tx: areas, obstacles, targets, starts, sight, and models of functions."""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.records import dataclass
from swarmdsl.syntax.ast.nodes import Documented, Node, Ref, Word
from swarmdsl.syntax.ast.values import Argument, Expression, PartValue


@dataclass(slots=True, eq=False)
class Point(Node):
    """`(3 m, 4 m)`."""

    x: Expression
    y: Expression


@dataclass(slots=True, eq=False)
class Box(Node):
    """`(0 m, 0 m) .. (60 m, 100 m)`."""

    low: Point
    high: Point


@dataclass(slots=True, eq=False)
class Height(Node):
    """`height 3 m` or `height 10 m .. 20 m`."""

    lower: Expression
    upper: Expression | None


@dataclass(slots=True, eq=False)
class Area(Documented):
    """`area name : box`."""

    name: Word
    box: Box
    height: Height | None


@dataclass(slots=True, eq=False)
class Zone(Documented):
    """`zone name : box`, where no robot may be."""

    name: Word
    box: Box
    height: Height | None


@dataclass(slots=True, eq=False)
class Wall(Documented):
    """`wall : (0 m, 50 m) -> (40 m, 50 m) height 3 m`."""

    points: list[Point]
    height: Height | None


@dataclass(slots=True, eq=False)
class Obstacle(Documented):
    """`obstacle name : (1 m, 2 m) .. (3 m, 4 m)`, or around one point, `radius 3 m`."""

    name: Word
    corner: Point
    opposite: Point | None
    radius: Expression | None
    height: Height | None


@dataclass(slots=True, eq=False)
class Targets(Documented):
    """`target kind[3] at random in area` or `target kind at (8 m, 4 m), (0 m, 2 m)`.

    `name` is the kind, `count` as written or empty.
    """

    name: Word
    count: str
    area: Ref[Area] | None
    places: list[Point]


@dataclass(slots=True, eq=False)
class Wind(Documented):
    """`wind 3 m/s to 90 deg from 5 min until 10 min`."""

    speed: Expression
    angle: Expression
    start: Expression | None
    end: Expression | None


@dataclass(slots=True, eq=False)
class Rain(Documented):
    """`rain from 14 min until 18 min`."""

    start: Expression | None
    end: Expression | None


@dataclass(slots=True, eq=False)
class Start(Node):
    """`in area` or `at (x, y)`: where robots are at first."""

    area: Ref[Area] | None
    point: Point | None


@dataclass(slots=True, eq=False)
class Sight(Documented):
    """`senses person { range = 20 m }` of a component."""

    target: Ref[Targets]
    values: list[PartValue]


@dataclass(slots=True, eq=False)
class Equipment(Documented):
    """`body { radius = 0.3 m }`, `battery { ... }` or `radio { ... }` of a member."""

    kind: Literal["body", "battery", "radio"]
    values: list[PartValue]


@dataclass(slots=True, eq=False)
class ModelUse(Documented):
    """`model coverage(width = 4 m)` of a function."""

    name: Word
    arguments: list[Argument]
