"""Avoidance: robots keep clear of what is nearest."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats
from swarmdsl.execution.space.functions.steering import unit


def nearest_on_segments(position: Floats, start: Floats, end: Floats) -> Floats:
    """Return the nearest point of each segment: arrays (..., 2) and (segments, 2)."""
    along = end - start
    square = np.maximum((along**2).sum(axis=-1), np.finfo(float).tiny)
    share = ((position[..., None, :] - start) * along).sum(axis=-1) / square
    near: Floats = start + np.clip(share, 0.0, 1.0)[..., None] * along
    return near


def clear_of(position: Floats, things: Floats, radius: Floats, keep: float) -> tuple[Floats, Flags]:
    """Return the direction away from what is too near, and whether a robot is clear.

    `things` (..., things, 2) are the nearest points of things, `radius` (..., things) what lies
    around those points. What is at the distance `keep` does not push, and what touches pushes
    with 1.
    """
    offset = position[..., None, :] - things
    gap = np.maximum(0.0, np.linalg.norm(offset, axis=-1) - radius)
    push = (unit(offset) * np.maximum(0.0, 1.0 - gap / keep)[..., None]).sum(axis=-2)
    size = np.linalg.norm(push, axis=-1, keepdims=True)
    return push / np.maximum(1.0, size), (gap >= keep).all(axis=-1)
