"""Paths: robots go from one point to the next."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats, Whole


def advance(
    position: Floats, path: Floats, leg: Whole, tolerance: float
) -> tuple[Floats, Whole, Flags]:
    """Return the offset to the next point, the number of that point, and who is at the end.

    `position` is (..., 3), `path` (..., points, 3) and `leg` has the number of the point that each
    robot goes to.
    """
    last = path.shape[-2] - 1
    leg = np.minimum(leg, last)
    offset = _point(path, leg) - position
    reached = np.linalg.norm(offset, axis=-1) <= tolerance
    done = reached & (leg == last)
    leg = np.where(reached & ~done, leg + 1, leg)
    return _point(path, leg) - position, leg, done


def _point(path: Floats, leg: Whole) -> Floats:
    return np.take_along_axis(path, leg[..., None, None], axis=-2)[..., 0, :]
