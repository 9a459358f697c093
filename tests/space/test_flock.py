"""Flocks: the published order of Vicsek's model, and the three rules of Reynolds.

Vicsek et al., Physical Review Letters 75, 1226 (1995), found that the order of a flock falls from 1
to nearly 0 as noise grows, that it rises with the density, and that without order it falls with the
root of the number of particles. Some of this is exact. In a step, the angle of each particle is
a mean that the past decides, and its own noise, evenly from -eta/2 to eta/2. So the mean of the
square of the order is at most 1/N + (1 - 1/N) (sin(eta/2) / (eta/2))^2, whatever the density; it is
that if all see all, and 1/N at eta = 2 pi.

Given the past, a square lies between 0 and 1: by Azuma and Hoeffding, the mean of n of them is
further from the mean of what was expected than t with a probability of at most 2 exp(-2 n t^2).
"""

from itertools import pairwise

import numpy as np
import pytest

from swarmdsl.execution.space.functions.flock import reynolds, vicsek
from swarmdsl.execution.space.functions.vectors import unit

DOUBT = 1e-6
"""Probability that a right model fails one of the comparisons with a mean."""


def _bound(samples):
    return np.sqrt(np.log(2 / DOUBT) / (2 * samples))


def _expected(particles, eta):
    return 1 / particles + (1 - 1 / particles) * np.sinc(eta / 2 / np.pi) ** 2


def _squares(particles, side, eta, steps, runs=1, speed=0.03, settle=200):
    """Return the squares of the order in a square with edges that meet, (runs, steps)."""
    chance = np.random.default_rng(particles)
    place = chance.random((runs, particles, 2)) * side
    angle = chance.random(runs * particles) * 2 * np.pi
    heading = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    found = np.empty((runs, steps))
    for step in range(-settle, steps):
        offset = place[:, :, None] - place[:, None]
        offset -= side * np.round(offset / side)
        near = (offset**2).sum(axis=-1) <= 1
        near[:, range(particles), range(particles)] = False
        run, first, second = near.nonzero()
        drawn = chance.random(runs * particles)
        heading = vicsek(heading, run * particles + first, run * particles + second, eta, drawn)
        groups = heading.reshape(runs, particles, 2)
        place = (place + speed * groups) % side
        if step >= 0:
            found[:, step] = (groups.mean(axis=1) ** 2).sum(axis=1)
    return found


@pytest.mark.parametrize("eta", [1.0, 3.0, 5.0])
def test_order_where_all_see_all_is_that_of_the_noise(eta):
    found = _squares(10, 0.7, eta, 5000, settle=1)
    assert abs(found.mean() - _expected(10, eta)) < _bound(5000)


@pytest.mark.parametrize(("particles", "side"), [(40, 3.1), (10, 10.0), (100, 5.0)])
def test_order_in_full_noise_is_that_of_chance(particles, side):
    found = _squares(particles, side, 2 * np.pi, 40, runs=50, settle=1)
    # The square of the sum of N independent directions of length 1/N has a spread below 1/N.
    assert abs(found.mean() - 1 / particles) < 5 / particles / np.sqrt(found.size)


def test_order_falls_with_noise():
    """Figure 2a of the paper, N = 40 at density 4; runs are independent, so their spread counts."""
    roots = [np.sqrt(_squares(40, 3.1, eta, 200, runs=12)).mean(axis=1) for eta in (0.5, 2, 3.5, 5)]
    for quiet, loud in pairwise(roots):
        spread = np.sqrt((quiet.var(ddof=1) + loud.var(ddof=1)) / len(quiet))
        assert quiet.mean() - loud.mean() > 4 * spread
    squares = [(each**2).mean() for each in roots]
    assert squares[0] > 0.9 * _expected(40, 0.5)
    for square, eta in zip(squares, (0.5, 2, 3.5, 5), strict=True):
        assert square < _expected(40, eta) + _bound(200 * 12)


def test_order_rises_with_density():
    """As figure 2b of the paper, but the same number in smaller squares: 1/N stays the same."""
    thin, middle, dense = (
        np.sqrt(_squares(40, side, 3.0, 200, runs=12)).mean(axis=1) for side in (12, 5, 2)
    )
    for less, more in ((thin, middle), (middle, dense)):
        spread = np.sqrt((less.var(ddof=1) + more.var(ddof=1)) / len(less))
        assert more.mean() - less.mean() > 4 * spread


def test_without_noise_all_head_the_same_way():
    assert _squares(40, 3.1, 0.0, 1, settle=1000).min() > 0.999


def test_alignment_counts_the_robot_itself():
    heading = np.array([[1.0, 0], [0, 1.0]])
    both = vicsek(heading, np.array([0]), np.array([1]), 1.0, np.array([0.5, 0.5]))
    assert both == pytest.approx(np.array([[np.sqrt(0.5), np.sqrt(0.5)], [0, 1]]))


def test_robots_that_meet_head_on_keep_their_headings():
    heading = np.array([[1.0, 0], [-1.0, 0]])
    assert vicsek(heading, *PAIR, 0.0, np.zeros(2)) == pytest.approx(heading)


def test_noise_is_centred_and_as_wide_as_said():
    none = np.array([], dtype=int)
    turned = vicsek(np.array([[1.0, 0], [1.0, 0]]), none, none, 0.8, np.array([0.0, 0.75]))
    assert np.arctan2(turned[:, 1], turned[:, 0]) == pytest.approx([-0.4, 0.2])


PAIR = (np.array([0, 1]), np.array([1, 0]))


def test_each_rule_of_reynolds_acts_on_its_own():
    place = np.array([[0.0, 0, 0], [2.0, 0, 0]])
    along = np.array([[0.0, 1, 0], [0.0, -1, 0]])
    apart = reynolds(place, along, *PAIR, np.full(2, 4.0), 100.0, 0, 0)
    assert apart[0] == pytest.approx([-1, 0, 0], abs=0.05)
    assert apart[1] == pytest.approx([1, 0, 0], abs=0.05)
    together = reynolds(place, along, *PAIR, np.full(2, 1.0), 5.0, 0, 100.0)
    assert together[0] == pytest.approx([1, 0, 0], abs=0.05)
    aligned = reynolds(place, along, *PAIR, np.full(2, 1.0), 0, 1.0, 0)
    assert aligned == pytest.approx(along[::-1])


def test_a_robot_alone_keeps_its_heading():
    place, along = np.zeros((1, 3)), np.array([[0.6, 0.8, 0.0]])
    none = np.array([], dtype=int)
    assert reynolds(place, along, none, none, np.ones(1), 1, 1, 1) == pytest.approx(along)


def test_flocking_turns_and_moves_with_the_world():
    chance = np.random.default_rng(0)
    place = chance.normal(size=(20, 3)) * 3
    along = unit(chance.normal(size=(20, 3)))
    first, second = (~np.eye(20, dtype=bool)).nonzero()
    angle = 0.7
    turn = np.array(
        [[np.cos(angle), np.sin(angle), 0], [-np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    )
    here = reynolds(place, along, first, second, np.full(20, 2.0), 1.5, 1.0, 0.8)
    there = reynolds(
        place @ turn + [5, -3, 2], along @ turn, first, second, np.full(20, 2.0), 1.5, 1.0, 0.8
    )
    assert there == pytest.approx(here @ turn, abs=1e-12)


def test_flocking_does_not_depend_on_the_order_of_robots():
    chance = np.random.default_rng(1)
    place, along = chance.normal(size=(9, 3)), unit(chance.normal(size=(9, 3)))
    first, second = (~np.eye(9, dtype=bool)).nonzero()
    mixed = chance.permutation(9)
    here = reynolds(place, along, first, second, np.ones(9), 1, 1, 1)
    there = reynolds(place[mixed], along[mixed], first, second, np.ones(9), 1, 1, 1)
    assert there == pytest.approx(here[mixed], abs=1e-12)
