"""Random places in an area, away from walls and obstacles."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Floats, Words
from swarmdsl.execution.space.hashing import key, shares
from swarmdsl.execution.space.shapes import Shapes

_ACROSS, _ALONG = key("start", "x"), key("start", "y")
_MOST_TRIES = 200


def places_in(
    bounds: tuple[float, float, float, float], keys: Words, radius: Floats, shapes: Shapes
) -> tuple[Floats, Floats]:
    """Return a place for each key, at least a radius away from all shapes if there is room."""
    x, y = np.zeros(len(keys)), np.zeros(len(keys))
    left = np.arange(len(keys))
    low_x, low_y, high_x, high_y = bounds
    for count in range(_MOST_TRIES):
        margin = np.minimum(radius[left], min(high_x - low_x, high_y - low_y) / 2)
        across, along = shares(keys[left], _ACROSS, count), shares(keys[left], _ALONG, count)
        x[left] = low_x + margin + (high_x - low_x - 2 * margin) * across
        y[left] = low_y + margin + (high_y - low_y - 2 * margin) * along
        if shapes.is_empty:
            break
        near = shapes.distances(x[left], y[left], np.zeros(len(left))) < radius[left]
        left = left[near | shapes.inside(x[left], y[left])]
        if not len(left):
            break
    return x, y
