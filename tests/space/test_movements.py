"""Movements of robots as pure functions: limits, symmetry, and what each one is for."""

import numpy as np
import pytest

from swarmdsl.execution.space.functions.avoid import clear_of, nearest_on_segments
from swarmdsl.execution.space.functions.disperse import away
from swarmdsl.execution.space.functions.dock import FREE, admit, release
from swarmdsl.execution.space.functions.follow_path import advance
from swarmdsl.execution.space.functions.form_up import goals, places
from swarmdsl.execution.space.functions.spray import footprint, wetted
from swarmdsl.execution.space.functions.steering import approach, limit, sums, unit


def _turn(angle):
    return np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])


def _pairs(count):
    return (~np.eye(count, dtype=bool)).nonzero()


def test_nobody_is_faster_than_its_body():
    velocity = np.random.default_rng(0).normal(size=(4, 50, 3)) * 10
    made = limit(velocity, 2.0, 0.5)
    assert np.linalg.norm(made[..., :2], axis=-1).max() <= 2.0 + 1e-12
    assert np.abs(made[..., 2]).max() <= 0.5
    slow = np.linalg.norm(velocity[..., :2], axis=-1) <= 2.0
    assert made[slow][:, :2] == pytest.approx(velocity[slow][:, :2])
    assert unit(made[..., :2]) == pytest.approx(unit(velocity[..., :2]))


def test_what_cannot_move_stays():
    assert limit(np.array([[3.0, 4.0, 1.0]]), 0.0, 0.0) == pytest.approx(np.zeros((1, 3)))
    assert approach(np.array([[3.0, 4.0, 1.0]]), 2.0, 0.0, 0.1) == pytest.approx(np.zeros((1, 3)))


def test_an_approach_is_straight_and_ends_at_its_goal():
    offset = np.array([[3.0, 4.0, 0.0], [0.3, 0.0, 0.0], [3.0, 4.0, 10.0], [0.0, 0.0, 0.0]])
    velocity = approach(offset, 2.0, 1.0, 0.2)
    assert velocity[0] == pytest.approx([1.2, 1.6, 0.0])
    assert velocity[1] * 0.2 == pytest.approx(offset[1])
    assert velocity[2] == pytest.approx([0.3, 0.4, 1.0])
    assert velocity[3] == pytest.approx([0, 0, 0])


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
        direction, clear = away(place, *_pairs(12), 2.0)
        place = place + 0.02 * direction
        if clear.all():
            break
    gaps = np.linalg.norm(place[:, None] - place, axis=-1) + 10 * np.eye(12)
    assert gaps.min() >= 2.0 - 0.04


def test_robots_at_one_place_part():
    direction, clear = away(np.zeros((2, 3)), *_pairs(2), 1.0)
    assert direction[0][0] < 0 < direction[1][0]
    assert not clear.any()


def test_dispersal_turns_with_the_world():
    place = np.random.default_rng(4).random((8, 2)) * 3
    here, clear = away(place, *_pairs(8), 2.0)
    there, same = away(place @ _turn(1.1) + [7, 2], *_pairs(8), 2.0)
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


def test_a_formation_turns_and_moves_with_its_robots():
    place = np.random.default_rng(5).random((3, 6, 2)) * 10
    here = goals(place, "wedge", 2.0, np.array([0.0, 0.5, 1.0]))
    there = goals(place @ _turn(0.4) + [1, 2], "wedge", 2.0, np.array([0.4, 0.9, 1.4]))
    assert there == pytest.approx(here @ _turn(0.4) + [1, 2])


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


def test_a_path_is_followed_point_by_point():
    path = np.array([[[1.0, 0, 0], [1.0, 1.0, 0], [0.0, 1.0, 0]]])
    place, leg, seen, done = np.zeros((1, 3)), np.zeros(1, dtype=int), [], np.array([False])
    for _ in range(100):
        offset, leg, done = advance(place, path, leg, 1e-6)
        seen.append(int(leg[0]))
        if done.all():
            break
        place = place + 0.1 * approach(offset, 1.0, 1.0, 0.1)
    assert done.all()
    assert place[0] == pytest.approx([0, 1, 0], abs=1e-6)
    assert sorted(set(seen)) == [0, 1, 2]
    assert len(seen) == pytest.approx(31, abs=2)


def test_nearest_points_of_walls():
    start, end = np.array([[0.0, 0], [5, 5]]), np.array([[10.0, 0], [5, 5]])
    near = nearest_on_segments(np.array([[3.0, 4], [-2, 1]]), start, end)
    assert near[0] == pytest.approx(np.array([[3, 0], [5, 5]]))
    assert near[1] == pytest.approx(np.array([[0, 0], [5, 5]]))


def test_avoiding_leads_away_until_clear():
    place = np.array([[0.0, 0.6]])
    wall = nearest_on_segments(place, np.array([[-5.0, 0]]), np.array([[5.0, 0]]))
    direction, clear = clear_of(place, wall, np.zeros((1, 1)), 1.0)
    assert direction[0] == pytest.approx([0, 0.4])
    assert not clear[0]
    assert clear_of(np.array([[0.0, 1.0]]), np.zeros((1, 1, 2)), np.zeros((1, 1)), 1.0)[1][0]
    # The body of a disc counts, not its centre.
    near = clear_of(np.array([[0.0, 1.4]]), np.zeros((1, 1, 2)), np.full((1, 1), 0.5), 1.0)
    assert not near[1][0]


def test_a_higher_camera_sees_a_wider_circle_until_its_range_ends():
    view = np.pi / 2
    low, high = footprint(np.array([2.0, 4.0]), view)
    assert (low, high) == (pytest.approx(2.0), pytest.approx(4.0))
    near, edge, above = footprint(np.array([2.0, 4.0, 6.0]), view, 5.0)
    assert (near, edge, above) == (pytest.approx(2.0), pytest.approx(3.0), 0.0)


def test_jets_wet_the_way_between_two_places():
    cells = np.array([[0.0, 0.4], [5.0, -0.4], [5.0, 0.6], [10.6, 0.0]])
    wet = wetted(np.array([[0.0, 0.0]]), np.array([[10.0, 0.0]]), 1.0, cells)
    assert wet.tolist() == [True, True, False, False]
    assert not wetted(np.zeros((0, 2)), np.zeros((0, 2)), 1.0, cells).any()
