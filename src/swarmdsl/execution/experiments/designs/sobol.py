"""Sobol sequence (I. Sobol, 1967), with a random digital shift.

The initial numbers are those of S. Joe and F. Kuo, "Constructing Sobol sequences with better
two-dimensional projections", 2008 (table new-joe-kuo-6). The shift adds random bits without carry
to all points of a dimension, which keeps how evenly they lie and avoids the corner at 0.
"""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.execution.simulate.scenario.random_source import RandomSource

_BITS = 32
# Degree and inner coefficients of the primitive polynomial, and the initial numbers, of the second
# dimension and those after it.
_POLYNOMIALS = (
    (1, 0, (1,)),
    (2, 1, (1, 3)),
    (3, 1, (1, 3, 1)),
    (3, 2, (1, 1, 1)),
    (4, 1, (1, 1, 3, 3)),
    (4, 4, (1, 3, 5, 13)),
    (5, 2, (1, 1, 5, 5, 17)),
    (5, 4, (1, 1, 5, 5, 5)),
    (5, 7, (1, 1, 7, 11, 19)),
    (5, 11, (1, 1, 5, 1, 1)),
    (5, 13, (1, 1, 1, 3, 11)),
    (5, 14, (1, 3, 5, 5, 31)),
    (6, 1, (1, 3, 3, 9, 7, 49)),
    (6, 13, (1, 1, 1, 15, 21, 21)),
    (6, 16, (1, 3, 1, 13, 27, 49)),
    (6, 19, (1, 1, 1, 15, 7, 5)),
    (6, 22, (1, 3, 1, 15, 13, 25)),
    (6, 25, (1, 1, 5, 5, 19, 61)),
    (7, 1, (1, 3, 7, 11, 23, 15, 103)),
    (7, 4, (1, 3, 7, 13, 13, 15, 69)),
    (7, 7, (1, 1, 3, 13, 7, 35, 63)),
    (7, 8, (1, 3, 5, 9, 1, 25, 53)),
    (7, 14, (1, 3, 1, 13, 9, 35, 107)),
    (7, 19, (1, 3, 1, 5, 27, 61, 31)),
    (7, 21, (1, 1, 5, 11, 19, 41, 61)),
    (7, 28, (1, 3, 5, 3, 3, 13, 69)),
    (7, 31, (1, 1, 7, 13, 1, 19, 1)),
    (7, 32, (1, 3, 7, 5, 13, 19, 59)),
    (7, 37, (1, 1, 3, 9, 25, 29, 41)),
    (7, 41, (1, 3, 5, 13, 23, 1, 55)),
    (7, 42, (1, 3, 7, 3, 13, 59, 17)),
)
MOST_DIMENSIONS = len(_POLYNOMIALS) + 1


def sobol_sequence(dimensions: int, points: int, seed: int | None) -> list[tuple[float, ...]]:
    """Return the first points of the sequence; without a shift if there is no seed.

    Powers of two are the numbers of points that lie most evenly.
    """
    columns = [_directions(dimension) for dimension in range(dimensions)]
    shifts = [_shift(seed, dimension) for dimension in range(dimensions)]
    found = []
    for number in _gray_steps(points):
        if number is not None:
            shifts = [state ^ column[number] for state, column in zip(shifts, columns, strict=True)]
        found.append(tuple(state / 2**_BITS for state in shifts))
    return found


def _gray_steps(points: int) -> Iterator[int | None]:
    """Yield which direction each point adds to the one before it (I. Antonov, V. Saleev, 1979)."""
    for number in range(points):
        yield None if number == 0 else (number & -number).bit_length() - 1


def _shift(seed: int | None, dimension: int) -> int:
    if seed is None:
        return 0
    return RandomSource(seed).stream("sobol", dimension).getrandbits(_BITS)


def _directions(dimension: int) -> list[int]:
    """Return the direction numbers of a dimension, the first bit of a share highest."""
    if dimension == 0:
        return [1 << (_BITS - 1 - bit) for bit in range(_BITS)]
    degree, inner, initial = _POLYNOMIALS[dimension - 1]
    found = [number << (_BITS - 1 - bit) for bit, number in enumerate(initial)]
    for bit in range(degree, _BITS):
        value = found[bit - degree] ^ (found[bit - degree] >> degree)
        for other in range(1, degree):
            if inner >> (degree - 1 - other) & 1:
                value ^= found[bit - other]
        found.append(value)
    return found
