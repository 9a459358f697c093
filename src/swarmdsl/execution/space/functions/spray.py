"""Spraying: the cells of a field that the jets of a robot have wetted."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats


def footprint(height: Floats, view: float, reach: Floats | float = np.inf) -> Floats:
    """Return the radius on the ground of a cone that looks down from a height.

    `view` is the full angle of the cone in radians, `reach` the greatest distance to its rim. It
    grows with the height, h tan(view / 2), until the rim is as far away as the reach; from there
    it shrinks, and above the reach there is none.
    """
    wide = height * np.tan(min(view, np.pi) / 2)
    rim = np.sqrt(np.maximum(0.0, np.square(reach) - np.square(height)))
    radius: Floats = np.minimum(wide, rim)
    return radius


def wetted(low: Floats, high: Floats, width: float, centres: Floats) -> Flags:
    """Return which cells (cells, 2) lie within half the width of the ways of robots.

    `low` and `high` (robots, 2) are the ends of the way of each robot in a step.
    """
    along = high - low
    square = np.maximum((along**2).sum(axis=-1), np.finfo(float).tiny)
    share = np.einsum("rcd,rd->rc", centres[None] - low[:, None], along) / square[:, None]
    nearest = low[:, None] + np.clip(share, 0.0, 1.0)[..., None] * along[:, None]
    gap = np.linalg.norm(centres[None] - nearest, axis=-1)
    wet: Flags = (gap <= width / 2).any(axis=0)
    return wet
