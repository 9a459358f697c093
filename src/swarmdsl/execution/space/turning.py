"""Cosine and sine from additions and multiplications alone.

Those of a platform differ in their last digit, and NumPy's with the length of an array: a run would
not be the same everywhere.
"""

from __future__ import annotations

import math

import numpy as np

from swarmdsl.execution.space.arrays import Floats

_QUARTER = math.pi / 2
# Taylor series up to the 17th power: less than 1e-16 away between -pi/4 and pi/4. Cosine and sine
# side by side: half as many calls of NumPy, which take longer than what they compute.
_SERIES = [
    np.array([[(-1) ** n / math.factorial(2 * n)], [(-1) ** n / math.factorial(2 * n + 1)]])
    for n in range(9)
]
_COSINES, _SINES = np.array([1.0, 0.0, -1.0, 0.0]), np.array([0.0, 1.0, 0.0, -1.0])
"""Those of the four right angles."""


def direction(angles: Floats) -> tuple[Floats, Floats]:
    """Return the cosines and sines of angles in radians."""
    quarters = np.rint(angles / _QUARTER)
    rest = angles - quarters * _QUARTER
    square = rest * rest
    both = _SERIES[-1] * square
    for factor in _SERIES[-2:0:-1]:
        both += factor
        both *= square
    both += _SERIES[0]
    cosine, sine = both[0], both[1] * rest
    turn = quarters.astype(np.int64) & 3
    across, along = _COSINES[turn], _SINES[turn]
    return across * cosine - along * sine, across * sine + along * cosine


def direction_of(angle: float) -> tuple[float, float]:
    """Return the cosine and the sine of one angle."""
    cosine, sine = direction(np.array([angle]))
    return float(cosine[0]), float(sine[0])
