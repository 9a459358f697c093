"""NSGA-II, the method of K. Deb, A. Pratap, S. Agarwal and T. Meyarivan, 2002.

A population moves to the front of several objectives, and spreads on it.
"""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

from swarmdsl.execution.experiments.search.domination import Losses, in_order
from swarmdsl.execution.experiments.search.space import Point, SearchSpace
from swarmdsl.execution.experiments.task import Candidate

POPULATION = 20
_CROSSED = 0.9
"""Share of the children that have two parents."""
_NEAR = 15.0, 20.0
"""Distribution indices of crossover and mutation: the greater, the nearer to the parents."""
_TRIES = 20
"""Tries to make a child that was not tried before."""


class Nsga:
    """A population of points with their losses."""

    def __init__(self, space: SearchSpace, seed: int) -> None:
        self._space = space
        self._chance = Random(seed)
        self._population: list[tuple[Point, Losses]] = []
        self._seen: set[Candidate] = set()

    def ask(self, most: int) -> list[Point]:
        """Return a generation."""
        return [self._new() for _ in range(min(most, POPULATION))]

    def tell(self, points: Sequence[Point], losses: Sequence[Losses]) -> None:
        """Keep the best of the population and the generation."""
        every = [*self._population, *zip(points, losses, strict=True)]
        order = in_order([each for _, each in every])
        self._population = [every[number] for number in order[:POPULATION]]

    def _new(self) -> Point:
        """Return a point that was not tried before, if one is found."""
        for _ in range(_TRIES):
            point = self._child() if self._population else self._anywhere()
            candidate = self._space.candidate(point)
            if candidate not in self._seen:
                self._seen.add(candidate)
                return point
        return self._anywhere()

    def _anywhere(self) -> Point:
        return tuple(self._chance.random() for _ in self._space.dimensions)

    def _child(self) -> Point:
        first, second = self._parent(), self._parent()
        if self._chance.random() < _CROSSED:
            first = tuple(self._between(a, b) for a, b in zip(first, second, strict=True))
        share = 1 / len(first)
        return tuple(self._mutated(x) if self._chance.random() < share else x for x in first)

    def _parent(self) -> Point:
        """Return the better of two: the population is in order."""
        one, other = (self._chance.randrange(len(self._population)) for _ in range(2))
        return self._population[min(one, other)][0]

    def _between(self, a: float, b: float) -> float:
        """Cross two values as one point would in binary (K. Deb and R. Agrawal, 1995)."""
        u = self._chance.random()
        power = 1 / (_NEAR[0] + 1)
        spread = (2 * u) ** power if u < 0.5 else (1 / (2 * (1 - u))) ** power
        side = 1 if self._chance.random() < 0.5 else -1
        return _inside(((a + b) + side * spread * (a - b)) / 2)

    def _mutated(self, x: float) -> float:
        """Move a value by a polynomial distribution."""
        u = self._chance.random()
        power = 1 / (_NEAR[1] + 1)
        step = (2 * u) ** power - 1 if u < 0.5 else 1 - (2 * (1 - u)) ** power
        return _inside(x + step)


def _inside(x: float) -> float:
    return min(max(x, 0.0), 1.0)
