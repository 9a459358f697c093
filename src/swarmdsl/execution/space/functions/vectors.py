"""Vectors of robots, and sums over pairs of neighbours.

An array of vectors has a row per robot. Pairs of neighbours are two arrays of equal length with
rows: each of `first` is near that of `second`. A pair is there in both directions.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swarmdsl.execution.space.arrays import Floats, Rows, Whole
from swarmdsl.execution.space.turning import direction

if TYPE_CHECKING:
    from swarmdsl.execution.space.stage import Stage


def lengths(vectors: Floats) -> Floats:
    """Return the length of each vector."""
    # The order of these sums does not depend on the number of vectors.
    square = vectors[:, 0] * vectors[:, 0]
    for axis in range(1, vectors.shape[1]):
        square = square + vectors[:, axis] * vectors[:, axis]
    made: Floats = np.sqrt(square)
    return made


def unit(vectors: Floats) -> Floats:
    """Return the vectors with length 1; those without a length stay zero."""
    length = lengths(vectors)[:, None]
    made: Floats = np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0)
    return made


def unit_or(instead: Floats, vectors: Floats) -> Floats:
    """Return the vectors with length 1, and others instead of those without a length."""
    found = unit(vectors)
    made: Floats = np.where(np.any(found != 0, axis=1, keepdims=True), found, instead)
    return made


def turned(vectors: Floats, angles: Floats) -> Floats:
    """Return vectors (x, y), each turned by an angle."""
    cosine, sine = direction(angles)
    x, y = vectors[:, 0], vectors[:, 1]
    return np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=1)


def at_most_one(vectors: Floats) -> Floats:
    """Return the vectors, with length 1 those that are longer."""
    return vectors / np.maximum(1.0, lengths(vectors))[:, None]


def sums(first: Rows, values: Floats, robots: int) -> Floats:
    """Return for each robot the sum of the values of its pairs."""
    return np.stack([np.bincount(first, each, robots) for each in values.T], axis=1)


def counts(first: Rows, robots: int) -> Whole:
    """Return for each robot the number of its pairs."""
    return np.bincount(first, minlength=robots)


def places(stage: Stage, who: Rows) -> Floats:
    """Return where robots are, as rows (x, y, z)."""
    return np.stack([stage.x[who], stage.y[who], stage.z[who]], axis=1)


def near_pairs(stage: Stage, who: Rows, reach: Floats) -> tuple[Rows, Rows]:
    """Return the pairs among some robots within the reach of the first, as numbers in `who`."""
    number = np.full(stage.rows, -1)
    number[who] = np.arange(len(who))
    first, second = stage.pairs(float(reach.max(initial=0.0)))
    among = (number[first] >= 0) & (number[second] >= 0)
    first, second = number[first[among]], number[second[among]]
    here = places(stage, who)
    near = lengths(here[second] - here[first]) <= reach[first]
    return first[near], second[near]
