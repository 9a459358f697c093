"""Search and random walks: what is published of them.

- P. M. Kareiva, N. Shigesada: Analyzing insect movement as a correlated random walk. Oecologia 56,
  234-238 (1983). After n legs of a walk whose turns have the mean cosine c, symmetrically, the mean
  square of the distance from the start is n E(l^2) + 2 E(l)^2 c/(1-c) (n - (1-c^n)/(1-c)).
  Without correlation it is n E(l^2), which for the time t = n E(l)/v is 4 D t with
  D = v E(l^2)/(4 E(l)).
- B. O. Koopman: Search and Screening. Operations Evaluation Group Report 56 (1946). An area A
  that is swept with width w and speed v without overlap is covered to the share w v t/A; no search
  covers more. Search at random covers 1 - exp(-w v t/A) of it.

Means of independent robots are compared with what is expected within five standard errors: by the
central limit theorem a right model fails one of them with a probability of 6e-7.
"""

from itertools import pairwise

import numpy as np
import pytest
from tests.space.stages import WALKER, Play, stage, units

LEG = 10.0
SPEED = 1.0


def _legs(dt, speed=SPEED):
    """Return the first two moments of a leg, which ends with a whole step."""
    ends = np.arange(0, int(1.5 * LEG / (speed * dt)) + 2)
    share = np.clip((ends * speed * dt - 0.5 * LEG) / LEG, 0, 1)
    weight, length = np.diff(share), ends[1:] * speed * dt
    assert weight.sum() == pytest.approx(1)
    return (weight * length).sum(), (weight * length**2).sum()


def _walked(legs, turn, robots=400, seeds=range(25)):
    """Return the squares of the distances of robots from their starts after some legs."""
    of = units(robots, WALKER.__class__(radius=0.1, speed=SPEED))
    play = Play(stage(of, seeds=tuple(seeds), size=None, step=500_000_000))
    on = play.stage
    start = on.x.copy(), on.y.copy()
    play.start("random_walk", range(on.rows), leg=LEG, turn=turn)
    done, square = np.zeros(on.rows, dtype=int), np.full(on.rows, np.nan)
    was = on.x.copy(), on.y.copy(), on.wanted_x.copy(), on.wanted_y.copy()
    while np.isnan(square).any():
        play.step()
        turned = np.abs(on.wanted_x - was[2]) + np.abs(on.wanted_y - was[3]) > 1e-12
        over = turned & (done == legs)
        new = over & np.isnan(square)
        square[new] = ((was[0] - start[0]) ** 2 + (was[1] - start[1]) ** 2)[new]
        done += turned
        was = on.x.copy(), on.y.copy(), on.wanted_x.copy(), on.wanted_y.copy()
    return square


@pytest.mark.parametrize(("turn", "legs"), [(2 * np.pi, 1), (2 * np.pi, 8), (2.0, 8), (0.8, 12)])
def test_random_walks_go_as_far_as_kareiva_and_shigesada_say(turn, legs):
    first, second = _legs(0.5)
    cosine = np.sinc(turn / 2 / np.pi)
    series = cosine / (1 - cosine) * (legs - (1 - cosine**legs) / (1 - cosine))
    expected = legs * second + 2 * first**2 * series
    found = _walked(legs, turn)
    error = found.std(ddof=1) / np.sqrt(len(found))
    assert abs(found.mean() - expected) < 5 * error
    assert 5 * error < 0.1 * expected


def test_a_random_walk_diffuses():
    """At a time, 4 D t holds up to the last leg, whose square is at most (1.5 times the mean)^2."""
    of = units(400, WALKER.__class__(radius=0.1, speed=SPEED))
    play = Play(stage(of, seeds=tuple(range(10)), size=None, step=500_000_000))
    on = play.stage
    x, y = on.x.copy(), on.y.copy()
    play.start("random_walk", range(on.rows), leg=LEG)
    first, second = _legs(0.5)
    for time in (100, 200, 400):
        while on.ticks[0] * on.dt < time:
            play.step()
        square = (on.x - x) ** 2 + (on.y - y) ** 2
        error = square.std(ddof=1) / np.sqrt(len(square))
        expected = SPEED * time * second / first
        assert abs(square.mean() - expected) < 5 * error + (1.5 * LEG) ** 2


SIDE, RADIUS = 40.0, 2.0


def _covered(model, robots, seconds, seeds=(1, 2, 3, 4), **given):
    body = WALKER.__class__(radius=RADIUS, speed=SPEED)
    play = Play(stage(units(robots, body), seeds=seeds, size=(SIDE, SIDE)))
    on = play.stage
    on.covering.is_wanted = True
    play.start(model, range(on.rows), **given)
    for _ in range(round(seconds / on.dt)):
        play.step()
    return np.array([on.covering.share(run) for run in range(len(seeds))])


def _swept(robots, seconds):
    """Return the share that robots can cover at most: their first circles, and their ways."""
    return robots * (2 * RADIUS * SPEED * seconds + np.pi * RADIUS**2) / SIDE**2


@pytest.mark.parametrize("seconds", [60, 200, 400])
def test_no_search_covers_more_than_its_sweep_width(seconds):
    # A cell counts if its middle is covered: cells are a quarter of the radius wide.
    edge = 1 + 0.25
    for model, given in (("coverage", {"width": 2 * RADIUS}), ("random_walk", {"leg": 20.0})):
        shares = _covered(model, 1, seconds, **given)
        assert (shares <= min(1.0, edge * _swept(1, seconds))).all()


def test_lanes_cover_nearly_all_in_the_time_of_the_sweep_width():
    """The way to the first lane, at most the diagonal, and those between the lanes are extra."""
    lanes = SIDE / (2 * RADIUS)
    seconds = (SIDE * lanes + SIDE + np.sqrt(2) * SIDE) / SPEED
    assert (_covered("coverage", 1, seconds, width=2 * RADIUS) > 0.95).all()


@pytest.mark.parametrize("robots", [1, 10, 40])
def test_robots_that_start_at_random_cover_what_independent_circles_do(robots):
    """A cell stays free if each robot, evenly anywhere inside, is further than the radius."""
    seeds = tuple(range(100))
    found = _covered("hover", robots, 1, seeds=seeds)
    side = RADIUS / 4
    middles = np.arange(side / 2, SIDE, side)
    fine = np.linspace(RADIUS, SIDE - RADIUS, 1000)
    # A robot is at the x of a circle around the cell's middle with the chord as its chance in y.
    half = np.sqrt(np.maximum(RADIUS**2 - (middles[:, None] - fine) ** 2, 0.0))
    low = np.maximum(middles[:, None, None] - half, RADIUS)
    high = np.minimum(middles[:, None, None] + half, SIDE - RADIUS)
    chance = np.maximum(high - low, 0.0).mean(axis=2) / (SIDE - 2 * RADIUS)
    expected = (1 - (1 - chance) ** robots).mean()
    error = found.std(ddof=1) / np.sqrt(len(seeds))
    assert abs(found.mean() - expected) < 5 * error


def test_search_at_random_covers_less_than_lanes_and_nearly_what_koopman_says():
    """Legs bounce off walls, so they cross each other more than lines at random do."""
    for seconds in (200, 400):
        swept = 2 * RADIUS * SPEED * seconds / SIDE**2
        lanes = _covered("coverage", 1, seconds, width=2 * RADIUS)
        walks = _covered("random_walk", 1, seconds, seeds=tuple(range(16)), leg=30.0)
        formula = 1 - np.exp(-swept)
        error = walks.std(ddof=1) / np.sqrt(len(walks))
        assert lanes.min() > walks.max()
        assert 0.9 * formula - 5 * error < walks.mean() < formula + 5 * error


def test_more_robots_cover_more_in_the_same_time():
    shares = [_covered("random_walk", robots, 120, leg=20.0) for robots in (1, 2, 4, 8)]
    for fewer, more in pairwise(shares):
        assert (more > fewer).all()
