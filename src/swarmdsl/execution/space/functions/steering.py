"""Velocities that movements are made of, for arrays of robots.

Arrays of positions and velocities end with the axis (x, y, z), in metres and metres a second.
Pairs of neighbours are two arrays of equal length with the numbers of robots: `first` is near
`second`. Each pair is there in both directions.
"""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Floats, Rows, Whole


def unit(vectors: Floats) -> Floats:
    """Return the vectors with length 1; those without a length stay zero."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    made: Floats = np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0)
    return made


def limit(velocity: Floats, speed: Floats | float, climb: Floats | float) -> Floats:
    """Return velocities that a body can reach: at most its speed and its rate of climb."""
    level = np.linalg.norm(velocity[..., :2], axis=-1)
    share = np.minimum(1.0, np.divide(speed, level, out=np.ones_like(level), where=level > 0))
    made = velocity.copy()
    made[..., :2] *= share[..., None]
    made[..., 2] = np.clip(velocity[..., 2], np.negative(climb), climb)
    return made


def approach(offset: Floats, speed: Floats | float, climb: Floats | float, dt: float) -> Floats:
    """Return the velocity to a point at an offset, which one step does not overshoot.

    A robot that climbs on its way keeps to the straight line, as slowly as its climb demands.
    """
    level = np.linalg.norm(offset[..., :2], axis=-1)
    rise = np.abs(offset[..., 2])
    slow = np.maximum(
        _time(level, speed),
        _time(rise, climb),
    )
    return offset / np.maximum(slow, dt)[..., None]


def _time(way: Floats, speed: Floats | float) -> Floats:
    fast = np.broadcast_to(np.asarray(speed, dtype=np.float64), way.shape)
    needed = np.divide(way, fast, out=np.full_like(way, np.inf), where=fast > 0)
    return np.where(way > 0, needed, 0.0)


def sums(first: Rows, values: Floats, robots: int) -> Floats:
    """Return for each robot the sum of the values of its pairs."""
    columns = [np.bincount(first, values[:, axis], robots) for axis in range(values.shape[1])]
    return np.stack(columns, axis=1) if columns else np.zeros((robots, 0))


def counts(first: Rows, robots: int) -> Whole:
    """Return for each robot the number of its pairs."""
    return np.bincount(first, minlength=robots)
