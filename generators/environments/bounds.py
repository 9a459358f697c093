"""Bounds of an environment on the ground."""

from __future__ import annotations

from swarmdsl.codegen import dataclass
from swarmdsl.ir import Box, Disc, Environment, Point, Shape


@dataclass(frozen=True)
class Bounds:
    """Rectangle on the ground, in metres."""

    left: float
    bottom: float
    right: float
    top: float

    @property
    def width(self) -> float:
        """Length along x."""
        return self.right - self.left

    @property
    def depth(self) -> float:
        """Length along y."""
        return self.top - self.bottom


def bounds_of(environment: Environment) -> Bounds | None:
    """Return the size of an environment, else the extent of what is in it, if there is anything."""
    if environment.size is not None:
        return Bounds(0.0, 0.0, environment.size[0], environment.size[1])
    points = _points(environment)
    if not points:
        return None
    xs, ys = [point.x for point in points], [point.y for point in points]
    return Bounds(min(xs), min(ys), max(xs), max(ys))


def _points(environment: Environment) -> list[Point]:
    found = [point for wall in environment.walls for point in wall.points]
    found += [point for targets in environment.targets for point in targets.places]
    shapes: list[Shape] = [item.shape for item in environment.obstacles]
    shapes += [item.box for item in environment.areas]
    shapes += [item.box for item in environment.zones]
    for shape in shapes:
        match shape:
            case Box(low=low, high=high):
                found += [low, high]
            case Disc(centre=at, radius=radius):
                found.append(Point(at.x - radius, at.y - radius))
                found.append(Point(at.x + radius, at.y + radius))
    return found
