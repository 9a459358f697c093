"""Parts of movements as functions of arrays: sums, symmetry, and who may go where."""

import numpy as np
import pytest

from swarmdsl.execution.space.functions.disperse import away
from swarmdsl.execution.space.functions.dock import FREE, admit, release
from swarmdsl.execution.space.functions.form_up import places
from swarmdsl.execution.space.functions.vectors import lengths, sums, turned, unit


def _turn(angle):
    return np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])


def _pairs(count):
    return (~np.eye(count, dtype=bool)).nonzero()


def test_sums_are_those_of_a_loop():
    chance = np.random.default_rng(2)
    first, values = chance.integers(0, 7, 40), chance.normal(size=(40, 3))
    looped = np.zeros((7, 3))
    for one, value in zip(first, values, strict=True):
        looped[one] += value
    assert sums(first, values, 7) == pytest.approx(looped)


def test_dispersing_robots_end_clear_of_each_other():
    place = np.random.default_rng(3).random((12, 3)) * [1, 1, 0]
    for _ in range(4000):
        direction, clear = away(place, *_pairs(12), np.full(12, 2.0))
        place = place + 0.02 * direction
        if clear.all():
            break
    gaps = np.linalg.norm(place[:, None] - place, axis=-1) + 10 * np.eye(12)
    assert gaps.min() >= 2.0 - 0.04


def test_robots_at_one_place_part():
    direction, clear = away(np.zeros((2, 3)), *_pairs(2), np.ones(2))
    assert direction[0][0] < 0 < direction[1][0]
    assert not clear.any()


def test_dispersal_turns_with_the_world():
    place = np.random.default_rng(4).random((8, 2)) * 3
    here, clear = away(place, *_pairs(8), np.full(8, 2.0))
    there, same = away(place @ _turn(1.1) + [7, 2], *_pairs(8), np.full(8, 2.0))
    assert there == pytest.approx(here @ _turn(1.1), abs=1e-12)
    assert (clear == same).all()


@pytest.mark.parametrize("shape", ["line", "wedge", "circle"])
@pytest.mark.parametrize("count", [1, 2, 5, 12])
def test_neighbours_in_a_formation_are_spaced(shape, count):
    made = places(shape, count, 3.0)
    assert made.mean(axis=0) == pytest.approx([0, 0], abs=1e-12)
    gaps = np.linalg.norm(made[:, None] - made, axis=-1)[~np.eye(count, dtype=bool)]
    if count > 1:
        assert gaps.min() == pytest.approx(3.0)


def test_formations_have_their_shapes():
    line = places("line", 4, 2.0)
    assert np.ptp(line[:, 0]) == 0
    assert np.ptp(line[:, 1]) == pytest.approx(6.0)
    wedge = places("wedge", 5, 2.0)
    assert wedge[:, 0].argmax() == 0
    assert wedge[1] * [1, -1] == pytest.approx(wedge[2])
    circle = places("circle", 6, 2.0)
    assert np.linalg.norm(circle, axis=1) == pytest.approx(np.full(6, 2.0))


def test_one_robot_at_a_charger_at_a_time_in_the_order_of_asking():
    guest = np.full((2, 1), FREE)
    asked = np.array([[3.0, 1.0, 2.0], [np.inf, np.inf, np.inf]])
    guest, asked = admit(guest, asked)
    assert guest.tolist() == [[1], [FREE]]
    again, asked = admit(guest, asked)
    assert again.tolist() == guest.tolist()
    leaves = np.array([[False, True, False], [True, True, True]])
    guest, asked = admit(release(guest, leaves), asked)
    assert guest.tolist() == [[2], [FREE]]


def test_two_chargers_take_two_robots():
    guest, asked = admit(np.full((1, 2), FREE), np.array([[0.0, 0.0, 0.0]]))
    assert guest.tolist() == [[0, 1]]
    assert np.isfinite(asked).tolist() == [[False, False, True]]


def test_random_requests_never_put_two_at_one_charger():
    chance = np.random.default_rng(6)
    guest, asked = np.full((20, 2), FREE), np.full((20, 5), np.inf)
    served = 0
    for time in range(200):
        idle = np.isinf(asked) & ~(guest[:, :, None] == np.arange(5)).any(axis=1)
        asked[idle & (chance.random((20, 5)) < 0.3)] = time
        guest = release(guest, chance.random((20, 5)) < 0.2)
        guest, asked = admit(guest, asked)
        held = np.sort(guest, axis=1)
        assert not ((held[:, 0] == held[:, 1]) & (held[:, 0] != FREE)).any()
        assert np.isinf(asked[np.arange(20)[:, None], np.maximum(guest, 0)][guest != FREE]).all()
        served += int((guest != FREE).sum())
        waits = np.isfinite(asked).any(axis=1)
        assert (guest[waits] != FREE).all()
    assert served > 1000


def test_vectors_are_turned_and_measured():
    vectors = np.array([[3.0, 4.0], [0.0, 0.0]])
    assert lengths(vectors) == pytest.approx([5, 0])
    assert unit(vectors) == pytest.approx(np.array([[0.6, 0.8], [0, 0]]))
    assert turned(vectors, np.array([np.pi / 2, 1.0])) == pytest.approx(np.array([[-4, 3], [0, 0]]))
