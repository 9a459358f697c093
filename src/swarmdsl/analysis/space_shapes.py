"""Shapes of an environment as numbers, in metres; None for what is not known."""

from __future__ import annotations

from math import hypot
from typing import NamedTuple

from swarmdsl.analysis.types.constant_folding import Folding
from swarmdsl.syntax.ast import (
    Area,
    Environment,
    Expression,
    Height,
    Obstacle,
    Point,
    Size,
    Zone,
    in_metres,
)

Place = tuple[float, float]


class Rectangle(NamedTuple):
    """Rectangle between two corners."""

    left: float
    bottom: float
    right: float
    top: float

    def distance(self, place: Place) -> float:
        """Return the distance of a place from it, 0 inside."""
        x = max(self.left - place[0], 0.0, place[0] - self.right)
        y = max(self.bottom - place[1], 0.0, place[1] - self.top)
        return hypot(x, y)

    def covers(self, other: Rectangle) -> bool:
        """Return True if the other one is inside of it."""
        return (
            self.left <= other.left
            and self.bottom <= other.bottom
            and self.right >= other.right
            and self.top >= other.top
        )


class Circle(NamedTuple):
    """Circle around a place."""

    x: float
    y: float
    radius: float

    def distance(self, place: Place) -> float:
        """Return the distance of a place from it, 0 inside."""
        return max(hypot(place[0] - self.x, place[1] - self.y) - self.radius, 0.0)

    def covers(self, other: Rectangle) -> bool:
        """Return True if a rectangle is inside of it."""
        corners = [(x, y) for x in (other.left, other.right) for y in (other.bottom, other.top)]
        return all(self.distance(corner) == 0.0 for corner in corners)


Shape = Rectangle | Circle


def number_of(given: Expression | None, folding: Folding) -> float | None:
    """Return the value of a constant expression in the unit of ROS."""
    if given is None or given.tree is None:
        return None
    value = folding.value(given.tree)
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return float(value) if is_number and value is not None else None


def place_of(point: Point, folding: Folding) -> Place | None:
    """Return the place of a point."""
    x, y = number_of(point.x, folding), number_of(point.y, folding)
    return (x, y) if x is not None and y is not None else None


def rectangle_of(low: Point, high: Point, folding: Folding) -> Rectangle | None:
    """Return the rectangle between two corners as they are given."""
    first, second = place_of(low, folding), place_of(high, folding)
    return Rectangle(*first, *second) if first is not None and second is not None else None


def corners_of(item: Area | Zone | Obstacle) -> tuple[Point, Point | None]:
    """Return the corners of an item, or the centre of a round one."""
    if isinstance(item, Obstacle):
        return item.corner, item.opposite
    return item.box.low, item.box.high


def shape_of(item: Area | Zone | Obstacle, folding: Folding) -> Shape | None:
    """Return the shape of an item on the ground."""
    low, high = corners_of(item)
    if high is not None:
        return rectangle_of(low, high, folding)
    centre = place_of(low, folding)
    radius = number_of(item.radius, folding) if isinstance(item, Obstacle) else None
    return Circle(*centre, radius) if centre is not None and radius is not None else None


def heights_of(height: Height | None, folding: Folding) -> tuple[float | None, float | None]:
    """Return the lowest and the highest height of an item; None for what is open or unknown."""
    if height is None:
        return 0.0, None
    first = number_of(height.lower, folding)
    return (0.0, first) if height.upper is None else (first, number_of(height.upper, folding))


def size_of(environment: Environment) -> tuple[float, ...] | None:
    """Return the width, the depth and perhaps the height of an environment."""
    size = next((item for item in environment.items if isinstance(item, Size)), None)
    if size is None:
        return None
    return tuple(map(in_metres, filter(None, (size.width, size.depth, size.height))))


def distance_from_line(start: Place, end: Place, place: Place) -> float:
    """Return the distance of a place from a line between two others."""
    along = (end[0] - start[0], end[1] - start[1])
    length = along[0] ** 2 + along[1] ** 2
    share = 0.0
    if length:
        share = ((place[0] - start[0]) * along[0] + (place[1] - start[1]) * along[1]) / length
        share = min(max(share, 0.0), 1.0)
    return hypot(place[0] - start[0] - share * along[0], place[1] - start[1] - share * along[1])
