"""First places of robots that do not overlap."""

from __future__ import annotations

import math

import numpy as np

from swarmdsl.execution.physics.mjcf import WALL
from swarmdsl.execution.space.arrays import Floats
from swarmdsl.execution.space.robots import Robots

_GAP = 0.02
"""Least distance between robots, in metres."""
_GOLDEN = math.pi * (3 - math.sqrt(5))
_MOST_TRIES = 500


def apart(robots: Robots, rows: slice) -> tuple[Floats, Floats]:
    """Return the places of the robots of a run; one in the way of another is beside it."""
    x, y, radius = robots.x[rows].copy(), robots.y[rows].copy(), robots.radius[rows]
    for number in range(len(x)):
        first_x, first_y, own = x[number], y[number], radius[number]
        for count in range(_MOST_TRIES):
            # A spiral of places that cover the ground evenly (H. Vogel, 1979).
            away = own * math.sqrt(count)
            at_x = first_x + away * math.cos(count * _GOLDEN)
            at_y = first_y + away * math.sin(count * _GOLDEN)
            if count and not _is_free(robots, at_x, at_y, own):
                continue
            near = np.hypot(x[:number] - at_x, y[:number] - at_y)
            if not (near < radius[:number] + own + _GAP).any():
                x[number], y[number] = at_x, at_y
                break
    return x, y


def _is_free(robots: Robots, x: float, y: float, radius: float) -> bool:
    if robots.bounds is not None:
        low_x, low_y, high_x, high_y = robots.bounds
        if not (low_x + radius <= x <= high_x - radius and low_y + radius <= y <= high_y - radius):
            return False
    if robots.shapes.is_empty:
        return True
    at_x, at_y = np.array([x]), np.array([y])
    near = robots.shapes.distances(at_x, at_y, np.zeros(1))[0] < radius + WALL
    return not near and not robots.shapes.inside(at_x, at_y)[0]
