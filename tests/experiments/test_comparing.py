"""Comparisons against SciPy, and how often their answers are right."""

from __future__ import annotations

import random

import pytest

from swarmdsl.execution.experiments.comparing import (
    compare,
    compare_paired,
    compare_unpaired,
    together,
)

A = [20.1, 22.4, 19.8, 25.0, 21.2]
B = [18.0, 19.5, 20.2, 17.7, 18.8, 19.9, 16.4]


def test_welch() -> None:
    """Made with SciPy 1.17.1: ttest_ind(A, B, equal_var=False).confidence_interval(0.95)."""
    found = compare_unpaired(A, B, "maximize", 0.95)
    assert found.interval == pytest.approx((0.463428823113766, 5.650856891171948))
    assert found.answer == "yes"
    assert found.superiority == pytest.approx(32 / 35)


def test_student() -> None:
    """Made with SciPy 1.17.1: ttest_rel(A, B[:5]).confidence_interval(0.95)."""
    found = compare_paired(A, B[:5], "maximize", 0.95)
    assert found.interval == pytest.approx((-0.6039977738676998, 6.323997773867701))
    assert found.answer == "not yet"


def test_the_answer_follows_the_goal() -> None:
    assert compare_unpaired(A, B, "minimize", 0.95).answer == "no"
    assert compare_unpaired(B, A, "minimize", 0.95).answer == "yes"


def test_common_seeds_make_pairs() -> None:
    a, b = {1: 5.0, 2: 7.0, 3: 6.0}, {2: 6.0, 3: 5.0, 9: 100.0}
    paired = compare(a, b, "maximize", 0.95)
    assert paired is not None
    assert (paired.is_paired, paired.runs, paired.difference) == (True, 2, 1.0)
    apart = compare(a, {9: 100.0, 10: 90.0}, "maximize", 0.95)
    assert apart is not None
    assert (apart.is_paired, apart.difference) == (False, 6.0 - 95.0)
    assert compare(a, {}, "maximize", 0.95) is None


@pytest.mark.parametrize(("count", "answer"), [(1, "not yet"), (5, "not yet"), (6, "yes")])
def test_equal_differences_need_as_many_runs_as_the_sign_test(count: int, answer: str) -> None:
    """Six differences have one sign by chance in 1 of 32 cases, five in 1 of 16."""
    found = compare_paired([1.0] * count, [0.0] * count, "maximize", 0.95)
    assert found.answer == answer
    assert found.more == (None if count == 6 else 6 - count)


@pytest.mark.parametrize(("count", "answer"), [(1, "not yet"), (3, "not yet"), (4, "no")])
def test_independent_runs_that_do_not_vary_need_as_many_as_the_rank_test(
    count: int, answer: str
) -> None:
    """Four values are below four others by chance in 1 of 35 cases, three in 1 of 10."""
    found = compare_unpaired([0.1] * count, [0.3] * count, "maximize", 0.95)
    assert (found.answer, found.more) == (answer, None)


def test_no_difference_is_never_decided() -> None:
    found = compare_paired([3.0] * 50, [3.0] * 50, "maximize", 0.95)
    assert (found.answer, found.more, found.superiority) == ("not yet", None, 0.5)


def test_more_is_what_decides_with_the_same_mean_and_deviation() -> None:
    differences = [1.0, -0.5] * 5
    found = compare_paired(differences, [0.0] * 10, "maximize", 0.95)
    assert found.answer == "not yet"
    assert found.more is not None
    again = [1.0, -0.5] * ((10 + found.more) // 2)
    assert compare_paired(again, [0.0] * len(again), "maximize", 0.95).answer == "yes"
    fewer = [1.0, -0.5] * ((10 + found.more) // 2 - 4)
    assert compare_paired(fewer, [0.0] * len(fewer), "maximize", 0.95).answer == "not yet"


@pytest.mark.parametrize("is_paired", [True, False])
def test_intervals_hold_the_truth_as_often_as_they_say(is_paired: bool) -> None:
    """Of 300 intervals of 90 %, 270 are expected, with a deviation of 5.2."""
    stream = random.Random(11)
    held = wrong = 0
    for _ in range(300):
        chance = [stream.gauss(0, 5) for _ in range(12)]
        a = [3.0 + each + stream.gauss(0, 1) for each in chance]
        if not is_paired:
            chance = [stream.gauss(0, 2) for _ in range(12)]
        b = [2.5 + each + stream.gauss(0, 2) for each in chance]
        found = (compare_paired if is_paired else compare_unpaired)(a, b, "maximize", 0.9)
        assert found.interval is not None
        held += found.interval.lower <= 0.5 <= found.interval.upper
        wrong += found.answer == "no"
    assert 270 - 3 * 5.2 <= held <= 270 + 3 * 5.2
    assert wrong <= 15


def test_intervals_hold_together() -> None:
    """Of 300 sets of 6 intervals, at least 285 hold all truths, with a deviation of 3.8."""
    stream = random.Random(5)
    held = 0
    for _ in range(300):
        sets = [[stream.gauss(0, 1) for _ in range(10)] for _ in range(6)]
        found = [compare_paired(each, [0.0] * 10, "maximize", together(0.95, 6)) for each in sets]
        held += all(each.answer == "not yet" for each in found)
    assert held >= 285 - 3 * 3.8
