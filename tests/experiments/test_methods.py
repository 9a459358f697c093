"""Methods of a search, on problems whose optimum is known."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import pairwise
from random import Random
from statistics import median

import numpy as np
import pytest
from cmaes import CMAwM

from swarmdsl.execution.experiments.search.methods import NAMES, Name, method_of
from swarmdsl.execution.experiments.search.space import Dimension, Point, SearchSpace

Problem = Callable[[Point], float]


def real(name: str) -> Dimension:
    return Dimension(name, "number", Fraction(-5), Fraction(5))


def whole(name: str, most: int = 10) -> Dimension:
    return Dimension(name, "whole", Fraction(0), Fraction(most), Fraction(1))


REALS = SearchSpace(tuple(map(real, "abc")))
MIXED = SearchSpace((real("a"), whole("b"), Dimension("c", "time", Fraction(0), Fraction(60))))


def scaled(point: Point) -> list[float]:
    return [10 * place - 5 for place in point]


def sphere(point: Point) -> float:
    return sum((each - 1.5) ** 2 for each in scaled(point))


def rosenbrock(point: Point) -> float:
    x = scaled(point)
    return sum(100 * (b - a * a) ** 2 + (1 - a) ** 2 for a, b in pairwise(x))


def mixed(point: Point) -> float:
    """The best is 2, 7 and 20 s."""
    found = MIXED.candidate(point).values
    seconds = float(str(found["c"]).removesuffix("us")) / 1e6 if "us" in found["c"] else None
    if seconds is None:
        number, unit = str(found["c"]).rstrip("mins"), str(found["c"])
        seconds = float(number) * (60 if unit.endswith("min") else 1e-3 if "ms" in unit else 1)
    return (found["a"] - 2) ** 2 + (found["b"] - 7) ** 2 + ((seconds - 20) / 6) ** 2


def noisy(problem: Problem, seed: int) -> Problem:
    chance = Random(seed)
    return lambda point: problem(point) + chance.gauss(0, 0.5)


def best_of(
    name: Name, space: SearchSpace, seen: Problem, true: Problem, budget: int, seed: int
) -> float:
    """Return the true value of the point that seems the best."""
    method = method_of(name, space, budget, seed)
    best: tuple[float, Point] | None = None
    left = budget
    while left > 0:
        points = method.ask(left)
        if not points:
            break
        left -= len(points)
        losses = [seen(point) for point in points]
        method.tell(points, [(loss,) for loss in losses])
        best = min([*([best] if best else []), *zip(losses, points, strict=True)])
    assert best is not None
    return true(best[1])


def direct(space: SearchSpace, seen: Problem, true: Problem, budget: int, seed: int) -> float:
    """Return what the package finds when it is used by itself."""
    width = len(space.dimensions)
    steps = np.array([1 / (each.size - 1) if each.size else 0.0 for each in space.dimensions])
    bounds = np.tile([0.0, 1.0], (width, 1))
    inner = CMAwM(np.full(width, 0.5), 0.3, bounds, steps, seed=seed)
    best: tuple[float, Point] | None = None
    for _ in range(budget // inner.population_size):
        told = []
        for _ in range(inner.population_size):
            outer, raw = inner.ask()
            point = tuple(map(float, outer))
            loss = seen(point)
            told.append((raw, loss))
            best = min(best or (loss, point), (loss, point))
        inner.tell(told)
    assert best is not None
    return true(best[1])


SEEDS = range(9)


@pytest.mark.parametrize(
    ("problem", "space", "noise"),
    [
        (sphere, REALS, False),
        (rosenbrock, REALS, False),
        (mixed, MIXED, False),
        (mixed, MIXED, True),
    ],
)
def test_cma_is_as_good_as_the_package_and_better_than_chance(
    problem: Problem, space: SearchSpace, noise: bool
) -> None:
    def seen(seed: int) -> Problem:
        return noisy(problem, seed) if noise else problem

    def found(name: Name) -> float:
        return median(best_of(name, space, seen(seed), problem, 300, seed) for seed in SEEDS)

    cma = found("cma")

    assert cma < found("random")
    # The same seeds: the same points, and the same chance.
    alone = median(direct(space, seen(seed), problem, 300, seed) for seed in SEEDS)
    assert cma <= alone + 1e-12
    if problem is mixed and not noise:
        assert cma < 0.01


def test_tpe_is_better_than_chance() -> None:
    def found(name: Name) -> float:
        return median(best_of(name, MIXED, mixed, mixed, 120, seed) for seed in range(3))

    assert found("tpe") < found("random")


@pytest.mark.parametrize("name", NAMES[1:])
def test_a_search_is_the_same_for_the_same_seed(name: Name) -> None:
    def points(seed: int) -> list[Point]:
        method = method_of(name, MIXED, 40, seed)
        found: list[Point] = []
        while len(found) < 40 and (asked := method.ask(40 - len(found))):
            method.tell(asked, [(mixed(each),) for each in asked])
            found += asked
        return found

    assert points(1) == points(1)
    assert 30 <= len(points(1)) <= 40
    if name != "grid":
        assert points(1) != points(2)


def test_a_grid_has_all_candidates_or_as_many_levels_as_fit() -> None:
    space = SearchSpace(
        (whole("n", 3), Dimension("s", "number", Fraction(1), Fraction(2), Fraction(1, 2)))
    )
    assert space.size == 12
    every = [space.candidate(point).values for point in space.grid(100)]
    assert [each["n"] for each in every] == [n for n in range(4) for _ in range(3)]
    assert [each["s"] for each in every[:3]] == [1.0, 1.5, 2.0]
    assert REALS.size is None
    assert len(list(REALS.grid(30))) == 27
    one = SearchSpace((whole("n", 0), real("a")))
    assert [one.candidate(each).values for each in one.grid(3)] == [
        {"a": -5.0, "n": 0},
        {"a": 0.0, "n": 0},
        {"a": 5.0, "n": 0},
    ]
    assert_one_dimension(method_of("cma", one, 50, 0).ask(50))


def assert_one_dimension(points: Sequence[Point]) -> None:
    """CMA-ES needs two dimensions: with one, it has another that means nothing."""
    assert {point[0] for point in points} == {0.0}
    assert len({point[1] for point in points}) == len(points)
