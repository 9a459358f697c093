"""Designs against what defines them, and sensitivity against functions with known indices."""

from __future__ import annotations

import math
from itertools import combinations

import pytest

from swarmdsl.execution.experiments.designs.factorial import combinations as count_combinations
from swarmdsl.execution.experiments.designs.factorial import full_factorial
from swarmdsl.execution.experiments.designs.factors import Factor, settle
from swarmdsl.execution.experiments.designs.indices import saltelli_points, sobol_indices
from swarmdsl.execution.experiments.designs.latin import latin_hypercube
from swarmdsl.execution.experiments.designs.morris import screen, trajectories
from swarmdsl.execution.experiments.designs.sobol import MOST_DIMENSIONS, sobol_sequence


def test_full_factorial_has_each_combination_once() -> None:
    factors = (Factor("a", (1, 2, 3)), Factor("b", ("x", "y")), Factor("c", (True, False)))
    points = full_factorial(factors)
    assert len(points) == len(set(points)) == count_combinations(factors) == 12
    assert points[:3] == [(1, "x", True), (1, "x", False), (1, "y", True)]


def test_shares_become_levels_or_numbers() -> None:
    levels, numbers = Factor("a", ("x", "y", "z")), Factor("b", low=2, high=4)
    shares = (0.0, 0.33, 0.34, 0.99, 1.0)
    assert [levels.at(share) for share in shares] == ["x", "x", "y", "z", "z"]
    assert [numbers.at(share) for share in (0.0, 0.5, 1.0)] == [2, 3, 4]
    assert settle((levels, numbers), (1.0, 0.25)) == ("z", 2.5)


@pytest.mark.parametrize("points", [1, 7, 50])
def test_latin_hypercube_has_one_point_in_each_part(points: int) -> None:
    found = latin_hypercube(4, points, seed=3)
    for column in zip(*found, strict=True):
        assert sorted(math.floor(share * points) for share in column) == list(range(points))
    assert found == latin_hypercube(4, points, seed=3)
    assert found != latin_hypercube(4, points, seed=4)


# Made with SciPy 1.17.1: scipy.stats.qmc.Sobol(32, scramble=False, bits=32).random(1024).
@pytest.mark.parametrize(
    ("number", "shares"),
    [
        (5, [0.875, 0.875, 0.125, 0.125, 0.625, 0.625]),
        (
            777,
            [0.6923828125, 0.9365234375, 0.1630859375, 0.3232421875, 0.2373046875, 0.8994140625],
        ),
    ],
)
def test_sobol_sequence_is_that_of_joe_and_kuo(number: int, shares: list[float]) -> None:
    point = sobol_sequence(MOST_DIMENSIONS, number + 1, None)[number]
    assert [point[each] for each in (0, 1, 2, 9, 20, 31)] == shares


def test_a_shift_keeps_how_evenly_a_sobol_sequence_lies() -> None:
    """Each dimension has a point in each 64th; each square of the first two, 8 by 8, has one."""
    points = sobol_sequence(MOST_DIMENSIONS, 64, seed=5)
    for column in zip(*points, strict=True):
        assert sorted(math.floor(64 * share) for share in column) == list(range(64))
    squares = {(math.floor(8 * first), math.floor(8 * second)) for first, second, *_ in points}
    assert len(squares) == 64
    assert points != sobol_sequence(MOST_DIMENSIONS, 64, seed=6)


def test_directions_of_a_sobol_sequence_are_independent() -> None:
    """No two dimensions are the same: a wrong initial number would make pairs of them alike."""
    columns = list(zip(*sobol_sequence(MOST_DIMENSIONS, 256, None), strict=True))
    for left, right in combinations(columns, 2):
        assert left != right


def _ishigami(shares: tuple[float, ...]) -> float:
    x, y, z = (math.pi * (2 * share - 1) for share in shares)
    return math.sin(x) + 7 * math.sin(y) ** 2 + 0.1 * z**4 * math.sin(x)


def test_sobol_indices_of_the_function_of_ishigami() -> None:
    """T. Ishigami and T. Homma, 1990: the variance and its parts are known."""
    b4, b8 = 0.1 * math.pi**4, 0.01 * math.pi**8
    variance = 7**2 / 8 + b4 / 5 + b8 / 18 + 1 / 2
    first = [(1 + b4 / 5) ** 2 / 2 / variance, 7**2 / 8 / variance, 0.0]
    both = b8 * (1 / 18 - 1 / 50) / variance
    total = [first[0] + both, first[1], both]
    values = [_ishigami(point) for point in saltelli_points(3, 1024, seed=1)]
    found = sobol_indices(3, values, 0.95, seed=1)
    assert found is not None
    assert [each.first for each in found] == pytest.approx(first, abs=0.02)
    assert [each.total for each in found] == pytest.approx(total, abs=0.02)
    for each, alone, whole in zip(found, first, total, strict=True):
        assert each.first_interval.lower <= alone <= each.first_interval.upper
        assert each.total_interval.lower <= whole <= each.total_interval.upper


def test_sobol_indices_of_the_g_function() -> None:
    """A. Saltelli and I. Sobol, 1995: a product of |4x - 2| + a by 1 + a."""
    weights = (0.0, 1.0, 4.5, 9.0)
    parts = [1 / 3 / (1 + a) ** 2 for a in weights]
    variance = math.prod(1 + part for part in parts) - 1
    points = saltelli_points(4, 1024, seed=2)
    values = [
        math.prod((abs(4 * x - 2) + a) / (1 + a) for x, a in zip(point, weights, strict=True))
        for point in points
    ]
    found = sobol_indices(4, values, 0.95, seed=2)
    assert found is not None
    totals = [part * (1 + variance) / (1 + part) / variance for part in parts]
    assert [each.first for each in found] == pytest.approx(
        [part / variance for part in parts], abs=0.02
    )
    assert [each.total for each in found] == pytest.approx(totals, abs=0.02)


def test_values_that_do_not_vary_have_no_indices() -> None:
    assert sobol_indices(2, [3.1] * (8 * 4), 0.95, seed=1) is None


def test_elementary_effects_of_a_linear_function_are_its_coefficients() -> None:
    points = trajectories(3, 6, seed=9)
    screened = screen(points, [5 * x - 2 * y + 0 * z for x, y, z in points])
    assert [each.mean for each in screened] == pytest.approx([5, -2, 0])
    assert [each.size for each in screened] == pytest.approx([5, 2, 0])
    assert [each.deviation for each in screened] == pytest.approx([0, 0, 0], abs=1e-9)


def test_elementary_effects_tell_an_interaction() -> None:
    """In x * y the effect of x is y, which is 1/2 in the mean of the grid."""
    points = trajectories(3, 400, seed=9)
    screened = screen(points, [x * y for x, y, _ in points])
    assert [each.mean for each in screened] == pytest.approx([0.5, 0.5, 0], abs=0.05)
    deviation = math.sqrt(5 / 36)  # of 0, 1/3, 2/3 and 1
    assert [each.deviation for each in screened[:2]] == pytest.approx([deviation] * 2, abs=0.03)
    assert screened[2].deviation == 0


def test_trajectories_stay_in_the_grid_and_change_one_factor_at_a_time() -> None:
    points = trajectories(4, 20, seed=1)
    assert len(points) == 20 * 5
    assert all(0 <= share <= 1 for point in points for share in point)
    for number in range(1, len(points)):
        changed = [a != b for a, b in zip(points[number - 1], points[number], strict=True)]
        assert number % 5 == 0 or sum(changed) == 1
