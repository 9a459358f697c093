"""Aggregation as of cockroaches: who meets others that rest is likelier to stop, and to stay.

- R. Jeanson, C. Rivault, J.-L. Deneubourg, S. Blanco, R. Fournier, C. Jost, G. Theraulaz:
  Self-organized aggregation in cockroaches. Animal Behaviour 69, 169-180 (2005).
- S. Garnier et al.: The embodiment of cockroach aggregation behavior in a group of micro-robots.
  Artificial Life 14, 387-408 (2008): the same rules in robots.

A robot that walks stops, and one that rests walks on, at a rate that depends on the number of
resting robots within reach.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats, Whole

STOP = (0.03, 0.42, 0.50, 0.51)
"""Rates to stop, per second, with 0, 1, 2, and 3 or more resting neighbours."""

LEAVE = (1 / 49, 1 / 424, 1 / 700, 1 / 1306)
"""Rates to walk on, per second, with 0, 1, 2, and 3 or more resting neighbours."""


def resting(
    rests: Flags,
    near: Whole,
    drawn: Floats,
    dt: float,
    stop: Sequence[float] = STOP,
    leave: Sequence[float] = LEAVE,
) -> Flags:
    """Return which robots rest after a step.

    `near` has the numbers of resting neighbours and `drawn` a number from 0 up to 1 for each robot.
    The time until a change has an exponential distribution, whatever the step.
    """
    changes = np.where(rests, _chances(leave, dt, near), _chances(stop, dt, near))
    return rests ^ (drawn < changes)


def _chances(rates: Sequence[float], dt: float, near: Whole) -> Floats:
    table = np.array([-math.expm1(-rate * dt) for rate in rates])
    return table[np.minimum(near, len(rates) - 1)]
