"""Dispersion: robots move away from those that are nearer than a distance."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats, Rows
from swarmdsl.execution.space.functions.steering import counts, sums, unit


def away(position: Floats, first: Rows, second: Rows, distance: float) -> tuple[Floats, Flags]:
    """Return the direction of each robot, at most of length 1, and whether it is clear.

    A robot is pushed from each neighbour nearer than `distance`, the more the nearer it is; it is
    clear if there is none. Robots at one place part along x, in the order of their numbers.
    """
    robots = len(position)
    offset = position[first] - position[second]
    length = np.linalg.norm(offset, axis=1)
    same = length == 0
    offset[same, 0] = np.sign(first[same] - second[same])
    close = length < distance
    push = unit(offset) * np.maximum(0.0, 1.0 - length / distance)[:, None]
    total = sums(first, push, robots)
    size = np.linalg.norm(total, axis=1, keepdims=True)
    return total / np.maximum(1.0, size), counts(first[close], robots) == 0
