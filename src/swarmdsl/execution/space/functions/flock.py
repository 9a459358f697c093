"""Flocking: separation, alignment and cohesion, or the alignment of Vicsek alone.

- C. W. Reynolds: Flocks, herds, and schools: a distributed behavioral model. SIGGRAPH 1987.
- T. Vicsek, A. Czirok, E. Ben-Jacob, I. Cohen, O. Shochet: Novel type of phase transition in a
  system of self-driven particles. Physical Review Letters 75, 1226 (1995).
"""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Floats, Rows
from swarmdsl.execution.space.functions.steering import counts, sums, unit
from swarmdsl.execution.space.turning import direction


def reynolds(
    position: Floats,
    heading: Floats,
    first: Rows,
    second: Rows,
    spacing: float,
    separation: float,
    alignment: float,
    cohesion: float,
) -> Floats:
    """Return the direction that each robot wants, as a vector of length 1.

    `position` and `heading`, vectors of length 1, have one row a robot. Separation acts between
    robots nearer than `spacing` and grows from 0 there to 1 where they touch; a robot without
    neighbours keeps its heading.
    """
    robots = len(position)
    offset = position[second] - position[first]
    distance = np.linalg.norm(offset, axis=1)
    near = np.maximum(0.0, 1.0 - distance / spacing)
    apart = -sums(first, unit(offset) * near[:, None], robots)
    number = counts(first, robots)
    mean = np.divide(1.0, number, out=np.zeros(robots), where=number > 0)[:, None]
    along = sums(first, heading[second], robots) * mean
    together = unit(sums(first, offset, robots) * mean)
    wanted = heading + separation * apart + alignment * (along - heading) + cohesion * together
    return _unit_or(heading, np.where(number[:, None] == 0, heading, wanted))


def vicsek(heading: Floats, first: Rows, second: Rows, noise: float, drawn: Floats) -> Floats:
    """Return the new heading of each robot: the mean of its neighbours and itself, and noise.

    Headings are rows (x, y) of length 1. `drawn` has a number from 0 up to 1 for each robot, and
    `noise` is the width of the interval of the noise, in radians: eta in the paper.
    """
    mean = _unit_or(heading, heading + sums(first, heading[second], len(heading)))
    cosine, sine = direction(noise * (drawn - 0.5))
    x, y = mean[:, 0], mean[:, 1]
    return np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=1)


def _unit_or(instead: Floats, vectors: Floats) -> Floats:
    """Return the vectors with length 1, and others instead of those that have none."""
    found = unit(vectors)
    made: Floats = np.where(np.any(found != 0, axis=1, keepdims=True), found, instead)
    return made
