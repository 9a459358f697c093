"""Aggregation: robots rest as the rates of the model say, and groups as its Markov chain does.

The rates have not been checked against the tables of the paper that the model names.

Where all see all, the number of resting robots is a Markov chain: of k that rest, each walks on at
the rate for k - 1 neighbours, and each of the others stops at the rate for k. Its distribution
after any time is exact, and a share of n independent runs is further from it than t with
a probability of at most 2 exp(-2 n t^2) (Hoeffding).
"""

from math import comb

import numpy as np
import pytest

from swarmdsl.execution.space.functions.aggregate import LEAVE, STOP, resting

ROBOTS = 6
DT = 0.5
DOUBT = 1e-6


def _bound(samples, comparisons=1):
    return np.sqrt(np.log(2 * comparisons / DOUBT) / (2 * samples))


def _binomial(number, chance):
    counts = np.arange(number + 1)
    ways = np.array([comb(number, k) for k in counts], dtype=float)
    return ways * chance**counts * (1 - chance) ** (number - counts)


def _chain():
    """Return the probabilities of a step from each number of resting robots to each other."""
    step = np.zeros((ROBOTS + 1, ROBOTS + 1))
    for rest in range(ROBOTS + 1):
        stopping = 1 - np.exp(-STOP[min(rest, 3)] * DT)
        leaving = 1 - np.exp(-LEAVE[min(max(rest - 1, 0), 3)] * DT)
        for stopped, first in enumerate(_binomial(ROBOTS - rest, stopping)):
            for left, second in enumerate(_binomial(rest, leaving)):
                step[rest, rest + stopped - left] += first * second
    return step


@pytest.mark.parametrize("seconds", [10, 100, 600])
def test_groups_rest_as_the_chain_says(seconds):
    runs = 4000
    chance = np.random.default_rng(seconds)
    rests = np.zeros((runs, ROBOTS), dtype=bool)
    for _ in range(int(seconds / DT)):
        near = rests.sum(axis=1, keepdims=True) - rests
        rests = resting(rests, near, chance.random(rests.shape), DT)
    shares = np.bincount(rests.sum(axis=1), minlength=ROBOTS + 1) / runs
    exact = np.linalg.matrix_power(_chain(), int(seconds / DT))[0]
    assert np.abs(shares - exact).max() < _bound(runs, ROBOTS + 1)


@pytest.mark.parametrize("near", [0, 1, 2, 3, 7])
@pytest.mark.parametrize("dt", [0.1, 1.0])
def test_rests_last_as_long_as_published_whatever_the_step(near, dt):
    runs, mean = 20_000, 1 / LEAVE[min(near, 3)]
    chance = np.random.default_rng(near)
    steps = round(20 / dt)
    rests = np.ones(runs, dtype=bool)
    still = rests.copy()
    for _ in range(steps):
        rests = resting(rests, np.full(runs, near), chance.random(runs), dt)
        still &= rests
        rests = still.copy()
    assert abs(still.mean() - np.exp(-20 / mean)) < _bound(runs)


def test_company_makes_robots_stop_sooner_and_stay_longer():
    walks, rests = np.zeros(4, dtype=bool), np.ones(4, dtype=bool)
    near = np.arange(4)
    assert resting(walks, near, np.full(4, 0.1), 0.3).tolist() == [False, True, True, True]
    assert resting(rests, near, np.full(4, 0.01), 1.0).tolist() == [False, True, True, True]
