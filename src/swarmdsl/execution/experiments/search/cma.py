"""CMA-ES with margin, by the package `cmaes`.

It is the method of R. Hamano, S. Saito, M. Nomura and S. Shirakawa, 2022, for real, stepped and
whole numbers.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from cmaes import CMAwM

from swarmdsl.execution.experiments.search.domination import Losses
from swarmdsl.execution.experiments.search.space import Dimension, Point, SearchSpace

_WIDTH = 0.3
"""First standard deviation, of an edge of the cube."""
_MOST_VALUES = 10_000
"""Values of a setting with steps, of more it is continuous until it is rounded."""


class Cma:
    """A search that begins in the middle, and anew with a larger generation when it has settled."""

    def __init__(self, space: SearchSpace, seed: int) -> None:
        self._moving = [index for index, each in enumerate(space.dimensions) if each.size != 1]
        self._width = len(space.dimensions)
        self._steps = [_step(space.dimensions[index]) for index in self._moving]
        # The method needs two dimensions; the last one of these means nothing.
        self._steps += [0.0] * max(2 - len(self._steps), 0)
        self._seed = seed
        self._starts = 0
        self._asked: list[Any] = []
        self._inner = self._start()

    def ask(self, most: int) -> list[Point]:
        """Return a generation, or a part of it if there is no room for more."""
        if self._inner.should_stop():
            self._starts += 1
            self._inner = self._start()
        pairs = [self._inner.ask() for _ in range(min(most, self._inner.population_size))]
        self._asked = [inner for _, inner in pairs]
        return [self._point(outer) for outer, _ in pairs]

    def tell(self, points: Sequence[Point], losses: Sequence[Losses]) -> None:
        """Move the distribution to the better half of a whole generation."""
        if len(points) == self._inner.population_size:
            first = [each for each, *_ in losses]
            self._inner.tell(list(zip(self._asked, first, strict=True)))

    def _point(self, found: Any) -> Point:
        places = [0.0] * self._width
        for index, place in zip(self._moving, found, strict=False):
            places[index] = float(place)
        return tuple(places)

    def _start(self) -> Any:
        count = len(self._steps)
        usual = 4 + math.floor(3 * math.log(count))
        return CMAwM(
            mean=np.full(count, 0.5),
            sigma=_WIDTH,
            bounds=np.tile([0.0, 1.0], (count, 1)),
            steps=np.array(self._steps),
            seed=self._seed + self._starts,
            population_size=usual * 2**self._starts,
        )


def _step(dimension: Dimension) -> float:
    size = dimension.size
    return 1 / (size - 1) if size is not None and 1 < size <= _MOST_VALUES else 0.0
