"""Arrays of a space: shapes, neighbours, random numbers and directions."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest

from swarmdsl.execution.space.hashing import key, shares
from swarmdsl.execution.space.neighbours import pairs
from swarmdsl.execution.space.shapes import UNBOUNDED, Edge, Round, Shapes
from swarmdsl.execution.space.turning import direction

WALL = Edge(0, 5, 10, 5, 0, 3, True, 0)


def floats(*values: float) -> np.ndarray:
    return np.array(values, dtype=np.float64)


@pytest.mark.parametrize("radius", [1.5, 3.0, 40.0])
def test_the_grid_finds_all_pairs(radius: float) -> None:
    chance = random.Random(1)
    count = 150
    x = floats(*(chance.uniform(-20, 20) for _ in range(count)))
    y = floats(*(chance.uniform(-20, 20) for _ in range(count)))
    run = np.array([number % 3 for number in range(count)])
    rows = np.array([number for number in range(count) if number % 7])
    expected = [
        (one, other)
        for one in rows
        for other in rows
        if one != other
        and run[one] == run[other]
        and (x[one] - x[other]) ** 2 + (y[one] - y[other]) ** 2 <= radius**2
    ]
    first, second = pairs(x, y, run, rows, radius)
    assert list(zip(first.tolist(), second.tolist(), strict=True)) == expected
    assert expected


def test_no_pairs_of_nobody() -> None:
    nobody = np.empty(0, dtype=np.int64)
    first, second = pairs(floats(), floats(), nobody, nobody, 1.0)
    assert len(first) == len(second) == 0


def test_directions_are_those_of_the_cosine() -> None:
    angles = np.linspace(-20, 20, 4001)
    cosine, sine = direction(angles)
    assert np.abs(cosine - np.cos(angles)).max() < 1e-14
    assert np.abs(sine - np.sin(angles)).max() < 1e-14


def test_numbers_of_a_robot_do_not_depend_on_others() -> None:
    keys = np.array([key(1, f"uav[{n}]") for n in range(100)], dtype=np.uint64)
    together = shares(keys, key("turn"), 3)
    alone = [shares(keys[n : n + 1], key("turn"), 3)[0] for n in range(100)]
    assert together.tolist() == alone
    assert shares(keys, key("turn"), 4).tolist() != alone


def test_numbers_are_uniform() -> None:
    drawn = shares(np.full(100_000, key(7, "uav[0]"), dtype=np.uint64), 5, np.arange(100_000))
    assert 0 <= drawn.min() < 0.001 < 0.999 < drawn.max() < 1
    counts = np.histogram(drawn, bins=20, range=(0, 1))[0]
    # Chi squared with 19 degrees of freedom: 43.8 is exceeded once in a thousand times.
    assert ((counts - 5000) ** 2 / 5000).sum() < 43.8
    assert abs(np.corrcoef(drawn[1:], drawn[:-1])[0, 1]) < 0.01


def test_distances_from_walls_and_discs() -> None:
    shapes = Shapes([WALL], [Round(20, 5, 2, 10)])
    x, y = floats(5, 13, 20, 5), floats(2, 1, 1, 2)
    assert shapes.distances(x, y, floats(0, 0, 0, 3)) == pytest.approx(
        [3, 5, 2, math.hypot(15, 3) - 2]
    )
    assert Shapes([], []).distances(x, y, None).tolist() == [UNBOUNDED] * 4


def test_lines_of_sight() -> None:
    box = [
        Edge(*line, 0, 4, True, 1)
        for line in ((2, 8, 4, 8), (4, 8, 4, 9), (4, 9, 2, 9), (2, 9, 2, 8))
    ]
    shapes = Shapes([WALL, *box], [Round(3, 12, 0.5, 1)])
    start = floats(3, 3, 3, 11), floats(0, 0, 0, 0)
    end = floats(3, 3, 3, 11), floats(14, 7, 14, 14)
    assert shapes.crossings(start, end, (np.zeros(4), np.zeros(4))).tolist() == [3, 1, 3, 0]
    above = floats(3.5, 3.5, 5, 0)
    assert shapes.crossings(start, end, (above, above)).tolist() == [1, 0, 0, 0]
    down = shapes.crossings(start, end, (floats(10, 10, 10, 10), np.zeros(4)))
    assert down.tolist() == [1, 1, 1, 0]


def test_a_body_that_touches_a_wall_stops() -> None:
    shapes = Shapes([WALL], [])
    start, end = (
        (floats(5, 5, 5, 5), floats(4, 4.6, 4, 4.8)),
        (floats(5, 5, 5, 5), floats(4.6, 4.2, 6, 4.7)),
    )
    radius, reach = np.full(4, 0.5), np.full(4, 2.5)
    assert shapes.touched(start, end, np.zeros(4), radius, reach).tolist() == [0, 2]
    assert not len(shapes.touched(start, end, np.full(4, 3.0), radius, reach))


def test_the_map_of_clearance_hides_no_contact() -> None:
    chance = random.Random(3)
    edges = [
        Edge(*(chance.uniform(0, 50) for _ in range(4)), 0, UNBOUNDED, True, n) for n in range(8)
    ]
    shapes = Shapes(edges, [Round(25, 25, 3, UNBOUNDED)])
    count = 2000
    x, y = (floats(*(chance.uniform(-5, 55) for _ in range(count))) for _ in range(2))
    radius = np.full(count, 0.4)
    end = x + 0.3, y - 0.2
    low = np.zeros(count)
    touched = np.zeros(count, dtype=bool)
    touched[shapes.touched((x, y), end, low, radius, radius + 0.37)] = True
    before, after = shapes.distances(x, y, low), shapes.distances(*end, low)
    near = (after < radius) & (after < before)
    through = shapes.crossings((x, y), end, (low, low)) > 0
    assert (touched & near == near).all()
    assert near.any()
    walls = Shapes(edges, []).crossings((x, y), end, (low, low)) > 0
    assert walls.any()
    assert touched[walls].all()
    assert not (touched & ~near & ~through).any()
