"""Cosine and sine from additions and multiplications alone.

Those of a platform differ in their last digit, and NumPy's with the length of an array: a run would
not be the same everywhere.
"""

from __future__ import annotations

import math

import numpy as np

from swarmdsl.execution.space.arrays import Floats

_QUARTER = math.pi / 2
# Taylor series up to the 17th power: less than 1e-16 away between -pi/4 and pi/4.
_SINE = [(-1) ** n / math.factorial(2 * n + 1) for n in range(9)]
_COSINE = [(-1) ** n / math.factorial(2 * n) for n in range(9)]


def direction(angles: Floats) -> tuple[Floats, Floats]:
    """Return the cosines and sines of angles in radians."""
    quarters = np.rint(angles / _QUARTER)
    rest = angles - quarters * _QUARTER
    square = rest * rest
    sine = np.full_like(rest, _SINE[-1])
    cosine = np.full_like(rest, _COSINE[-1])
    for above, beside in zip(_SINE[-2::-1], _COSINE[-2::-1], strict=True):
        sine = sine * square + above
        cosine = cosine * square + beside
    sine = sine * rest
    turn = quarters.astype(np.int64) & 3
    swapped = (turn & 1) == 1
    first, second = np.where(swapped, sine, cosine), np.where(swapped, cosine, sine)
    first = np.where((turn == 1) | (turn == 2), -first, first)
    second = np.where(turn >= 2, -second, second)
    return first, second


def direction_of(angle: float) -> tuple[float, float]:
    """Return the cosine and the sine of one angle."""
    cosine, sine = direction(np.array([angle]))
    return float(cosine[0]), float(sine[0])
