"""Effects of factors against models whose effects are known."""

from __future__ import annotations

import random

import pytest

from swarmdsl.execution.experiments.designs.factorial import full_factorial
from swarmdsl.execution.experiments.designs.factors import Factor, Value
from swarmdsl.execution.experiments.designs.latin import latin_hypercube
from swarmdsl.execution.experiments.effects import effects
from swarmdsl.execution.experiments.slopes import slopes

HEIGHT = Factor("height", (2, 4, 6))
KIND = Factor("kind", ("old", "new"))
SPEED = Factor("speed", (1.0, 2.0))
FACTORS = (HEIGHT, KIND, SPEED)


def _number(value: Value) -> float:
    assert isinstance(value, (int, float))
    return float(value)


def _value(point: tuple[Value, ...]) -> float:
    """Height adds -2, 0, 2; new adds 1, old -1; both together 0.5 per step; speed nothing."""
    height, kind, *_ = point
    step, sign = (_number(height) - 4) / 2, 1 if kind == "new" else -1
    return 10 + 2 * step + sign + 0.5 * step * sign


def test_effects_without_chance_are_those_of_the_model() -> None:
    table = {point: {1: _value(point), 2: _value(point)} for point in full_factorial(FACTORS)}
    found = effects(FACTORS, table, 0.95)
    assert found is not None
    assert found.mean == pytest.approx(10)
    height, kind, speed = found.main
    assert [each.added for each in height.levels] == pytest.approx([-2, 0, 2])
    assert [each.mean for each in kind.levels] == pytest.approx([9, 11])
    assert [each.added for each in speed.levels] == pytest.approx([0, 0])
    together = {each.factors: each for each in found.interactions}
    assert [each.added for each in together["height", "kind"].levels] == pytest.approx(
        [0.5, -0.5, 0, 0, -0.5, 0.5]
    )
    # Variances: 8/3 of the height, 1 of the kind, 1/6 of both.
    whole = 8 / 3 + 1 + 1 / 6
    shares = [each.share for each in (*found.main, *found.interactions)]
    assert shares == pytest.approx([8 / 3 / whole, 1 / whole, 0, 1 / 6 / whole, 0, 0])
    assert found.rest == pytest.approx(0)
    # Two runs that agree show nothing: the sign test has half a chance.
    assert not any(each.is_certain for each in found.main)


def test_effects_are_certain_if_chance_does_not_explain_them() -> None:
    """Seeds have much in common, which does not hide the effects; speed has none."""
    stream = random.Random(2)
    luck = {seed: stream.gauss(0, 20) for seed in range(30)}
    table = {
        point: {seed: _value(point) + luck[seed] + stream.gauss(0, 1) for seed in luck}
        for point in full_factorial(FACTORS)
    }
    found = effects(FACTORS, table, 0.95)
    assert found is not None
    certain = [each.factors for each in (*found.main, *found.interactions) if each.is_certain]
    assert certain == [("height",), ("kind",), ("height", "kind")]


def test_intervals_of_effects_hold_the_truth() -> None:
    """Of 300 designs, at least 285 hold all effects of the height, with a deviation of 3.8."""
    stream = random.Random(8)
    points = full_factorial((HEIGHT, KIND))
    held = 0
    for _ in range(300):
        table: dict[tuple[Value, ...], dict[int, float]] = {point: {} for point in points}
        for seed in range(6):
            luck = stream.gauss(0, 3)
            for point in points:
                table[point][seed] = _value(point) + luck * _number(point[0]) + stream.gauss(0, 1)
        found = effects((HEIGHT, KIND), table, 0.95)
        assert found is not None
        held += all(
            each.added_interval is not None
            and each.added_interval.lower <= truth <= each.added_interval.upper
            for each, truth in zip(found.main[0].levels, (-2, 0, 2), strict=True)
        )
    assert held >= 285 - 3 * 3.8


def test_seeds_that_lack_a_point_are_left_out() -> None:
    table = {point: {1: 1.0, 2: 2.0, 3: 3.0} for point in full_factorial(FACTORS)}
    del table[2, "old", 1.0][2]
    found = effects(FACTORS, table, 0.95)
    assert found is not None
    assert (found.seeds, found.left_out, found.mean) == ((1, 3), 1, 2.0)
    assert [each.share for each in found.main] == [None, None, None]
    assert effects(FACTORS, {point: {} for point in table}, 0.95) is None


def test_slopes_of_a_latin_hypercube_are_those_of_a_linear_model() -> None:
    factors = (Factor("height", low=0, high=10), Factor("speed", low=1, high=3), KIND)
    stream = random.Random(4)
    points = [
        tuple(factor.at(share) for factor, share in zip(factors, shares, strict=True))
        for shares in latin_hypercube(3, 40, seed=1)
    ]
    table = {
        point: {
            seed: 3 + 2 * _number(point[0]) + 4 * (point[2] == "new") + stream.gauss(0, 0.5)
            for seed in range(20)
        }
        for point in points
    }
    found = slopes(factors, table, 0.95)
    assert found is not None
    height, speed, kind = found.slopes
    assert (kind.start, kind.end) == ("old", "new")
    width = _number(height.end) - _number(height.start)
    assert height.change == pytest.approx(2 * width, abs=0.4)
    assert kind.change == pytest.approx(4, abs=0.3)
    assert [each.is_certain for each in (height, speed, kind)] == [True, False, True]
    assert found.explained == pytest.approx(1, abs=0.01)


def test_slopes_need_more_points_than_factors_and_no_alias() -> None:
    a, b = Factor("a", low=0, high=1), Factor("b", low=0, high=1)
    few = {(0.1, 0.4): {1: 1.0}, (0.6, 0.2): {1: 2.0}}
    assert slopes((a, b), few, 0.95) is None
    alias = {(each / 8, each / 8): {1: float(each)} for each in range(9)}
    assert slopes((a, b), alias, 0.95) is None
