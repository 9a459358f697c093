"""Intervals, quantiles and sequential tests against independent values."""

from __future__ import annotations

import random

import pytest

from swarmdsl.execution.estimation.intervals import clopper_pearson, student_quantile
from swarmdsl.execution.estimation.sample import summarize
from swarmdsl.execution.estimation.sequential import Region, SequentialTest


# Made with SciPy 1.17.1: scipy.stats.beta.ppf(a / 2, k, n - k + 1), ppf(1 - a / 2, k + 1, n - k).
@pytest.mark.parametrize(
    ("successes", "runs", "level", "lower", "upper"),
    [
        (0, 10, 0.95, 0.0, 0.3084971078187607),
        (10, 10, 0.95, 0.6915028921812392, 1.0),
        (3, 20, 0.95, 0.032070937185463715, 0.37892682654531396),
        (93, 100, 0.95, 0.8610802715441427, 0.9713947110925613),
        (93, 100, 0.99, 0.8371971444155772, 0.9792100696703757),
        (1, 1, 0.9, 0.05, 1.0),
        (500, 1000, 0.95, 0.468549172971792, 0.531450827028208),
        (9990, 10000, 0.999, 0.9974763699815818, 0.9997300116177676),
    ],
)
def test_clopper_pearson(
    successes: int, runs: int, level: float, lower: float, upper: float
) -> None:
    assert clopper_pearson(successes, runs, level) == pytest.approx((lower, upper), abs=1e-9)


# Made with SciPy 1.17.1: scipy.stats.t.ppf((1 + level) / 2, freedom).
@pytest.mark.parametrize(
    ("freedom", "level", "quantile"),
    [
        (1, 0.95, 12.706204736174694),
        (2, 0.95, 4.302652729749462),
        (9, 0.95, 2.262157162798205),
        (29, 0.99, 2.756385903670605),
        (99, 0.95, 1.9842169515864174),
        (999, 0.9, 1.646380345427535),
    ],
)
def test_student(freedom: int, level: float, quantile: float) -> None:
    assert student_quantile((1 + level) / 2, freedom) == pytest.approx(quantile, rel=1e-8)


def test_a_sample() -> None:
    found = summarize([4.0, 1.0, 3.0, 2.0], 0.95)
    assert found is not None
    assert found.mean == 2.5
    assert found.quantiles == pytest.approx((1.0, 1.15, 1.75, 2.5, 3.25, 3.85, 4.0))
    assert found.interval == pytest.approx((0.4457397, 4.5542603))  # SciPy: t.interval
    one = summarize([2.0], 0.95)
    assert one is not None
    assert one.interval is None
    assert summarize([], 0.95) is None


@pytest.mark.parametrize(("probability", "expected"), [(0.97, "high"), (0.83, "low")])
def test_the_errors_of_the_sequential_test(probability: float, expected: str) -> None:
    dice = random.Random(3)
    wrong = 0
    for _ in range(400):
        test = SequentialTest(Region.around(0.9, 0.05, 0.05))
        while test.decision is None:
            test.add(success=dice.random() < probability)
        wrong += test.decision != expected
    # Outside the region of indifference the errors are below 5 %.
    assert wrong < 20


@pytest.mark.parametrize(("probability", "success"), [(0.99, False), (0.01, True)])
def test_one_run_decides_nothing_near_0_and_1(probability: float, success: bool) -> None:
    test = SequentialTest(Region.around(probability, 0.02, 0.05))
    test.add(success=success)
    assert test.decision is None


@pytest.mark.parametrize("probability", [0.0, 0.5, 1.0])
def test_the_region_is_between_0_and_1(probability: float) -> None:
    region = Region.around(probability, 0.02, 0.01)
    assert 0 < region.lower < region.upper < 1
    test = SequentialTest(region)
    for _ in range(10_000):
        test.add(success=True)
    assert test.decision == "high"
    assert test.runs < 10_000
