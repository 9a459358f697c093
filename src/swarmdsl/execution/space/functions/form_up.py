"""Formations: a place for each robot in a line, a wedge or a circle."""

from __future__ import annotations

import math

import numpy as np

from swarmdsl.execution.space.arrays import Floats
from swarmdsl.execution.space.turning import direction

SHAPES = ("line", "wedge", "circle")


def places(shape: str, count: int, spacing: float) -> Floats:
    """Return the places of a formation that heads along x, around their mean: an array (count, 2).

    A line is across the heading; in a wedge the first is in front and the others are behind it by
    turns on the left and on the right; in a circle neighbours are `spacing` apart.
    """
    number = np.arange(count)
    if shape == "line":
        made = np.stack([np.zeros(count), spacing * number], axis=1)
    elif shape == "wedge":
        row = (number + 1) // 2
        side = np.where(number % 2 == 1, 1.0, -1.0)
        made = spacing * np.stack([-row, side * row], axis=1) / math.sqrt(2)
    else:
        radius = spacing / (2 * math.sin(math.pi / count)) if count > 1 else 0.0
        made = radius * np.stack(direction(2 * np.pi * number / max(count, 1)), axis=1)
    return made - made.mean(axis=0) if count else made


def goals(position: Floats, shape: str, spacing: float, heading: Floats | float) -> Floats:
    """Return the goal of each robot, around the mean of all: arrays (..., robots, 2).

    `heading` is the angle of the formation in radians, one for all or one a group.
    """
    slots = places(shape, position.shape[-2], spacing)
    cosine, sine = direction(np.asarray(heading, dtype=np.float64)[..., None])
    x, y = slots[:, 0], slots[:, 1]
    turned = np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)
    made: Floats = position.mean(axis=-2, keepdims=True) + turned
    return made
