"""Ways around what is in the way: as short as they can be, and clear of all shapes."""

import math

import numpy as np
import pytest
from tests.space.stages import FLYER, WALKER, Play, box, disc, stage, units, wall


def _went(start, to, *, body=WALKER, seconds=300, height=None, **around):
    """Let a robot go to a place; return how it ended, and how far it went."""
    play = Play(stage(units(1, body, starts=[start]), **around))
    play.start("go_to", [0], to=(*to, 0.0), height=height).run(seconds)
    on = play.stage
    arrived = math.dist((on.x[0], on.y[0]), to) < 0.15
    assert arrived == (play.outcomes() == ["succeeded"])
    return play.outcomes(), float(on.distance[0])


def test_nothing_in_the_way_is_gone_straight():
    assert _went((10, 10), (40, 50)) == (["succeeded"], pytest.approx(50, abs=0.1))


def test_around_the_end_of_a_wall():
    outcome, way = _went((40, 50), (60, 50), edges=wall((50, 0), (50, 60)))
    assert outcome == ["succeeded"]
    corner = math.dist((40, 50), (50, 60)) * 2
    assert corner < way < corner + 0.5  # the body has a radius


def test_around_a_disc_is_no_longer_than_tangents_and_an_arc():
    outcome, way = _went((30, 50), (70, 50), rounds=(disc(50, 50, 8),))
    assert outcome == ["succeeded"]
    radius, half = 8 + WALKER.radius, 20.0
    tangent = math.sqrt(half**2 - radius**2)
    shortest = 2 * tangent + radius * (math.pi - 2 * math.acos(radius / half))
    assert shortest - 0.15 < way < 1.01 * shortest


def test_out_of_a_maze_through_the_only_gap():
    """The gap is 5 cm wider than the body."""
    gap = 2 * WALKER.radius + 0.05
    walls = (
        *wall((30, 30), (70, 30), (70, 70), (30, 70), (30, 50 + gap)),
        *wall((30, 50), (30, 30), shape=1),
    )
    outcome, way = _went((50, 50), (90, 50), edges=walls)
    assert outcome == ["succeeded"]
    assert way > 20 + math.dist((30, 50), (70, 30))


def test_without_any_way_something_stops_it():
    """The gap is 5 cm too narrow."""
    gap = 2 * WALKER.radius - 0.05
    walls = (
        *wall((30, 30), (70, 30), (70, 70), (30, 70), (30, 50 + gap)),
        *wall((30, 50), (30, 30), shape=1),
    )
    outcome, way = _went((50, 50), (90, 50), edges=walls)
    assert outcome == ["aborted"]
    assert way == pytest.approx(20 - WALKER.radius, abs=0.2)


def test_what_flies_goes_over_what_is_lower():
    low = {"edges": wall((50, 0), (50, 100), high=3.0)}
    assert _went((40, 50), (60, 50), body=FLYER, height=5.0, **low)[0] == ["succeeded"]
    assert _went((48, 50), (60, 50), body=FLYER, height=5.0, **low)[0] == ["succeeded"]
    assert _went((40, 50), (60, 50), body=FLYER, height=2.0, **low)[0] == ["aborted"]


@pytest.mark.parametrize("seed", range(2))
def test_among_obstacles_every_place_that_is_free_is_reached(seed):
    chance = np.random.default_rng(seed)
    corners = chance.uniform(10, 80, (12, 2))
    edges = tuple(
        edge
        for number, (x, y) in enumerate(corners)
        for edge in box((x, y), (x + 6, y + 4), shape=number)
    )
    rounds = tuple(disc(x, y, 3.0) for x, y in chance.uniform(10, 90, (6, 2)))
    around = {"edges": edges, "rounds": rounds}
    outcome, way = _went((2, 2), (97, 97), **around)
    assert outcome == ["succeeded"]
    assert math.dist((2, 2), (97, 97)) - 0.2 < way < 1.3 * math.dist((2, 2), (97, 97))
    assert _went((2, 2), (97, 97), **around) == (outcome, way)


def test_home_is_where_a_robot_started_unless_it_is_told():
    play = Play(stage(units(2, starts=[(10, 10), (40, 40)]), edges=wall((20, 0), (20, 60))))
    play.start("go_to", [0, 1], to=(30.0, 10.0, 0.0)).run(200)
    play.start("go_home", [0], to=(0.0, 0.0, 0.0)).start("go_home", [1], to=(35.0, 5.0, 0.0))
    on = play.run(200).stage
    assert play.outcomes() == ["succeeded", "succeeded"]
    assert (*on.x, *on.y) == pytest.approx((10, 35, 10, 5), abs=0.2)


def test_what_flies_home_can_land_there():
    play = Play(stage(units(1, FLYER, starts=[(10, 10)])))
    play.start("go_to", [0], to=(30.0, 10.0, 8.0)).run(60)
    on = play.start("go_home", [0], end=0.0).run(60).stage
    assert play.outcomes() == ["succeeded"]
    assert (on.x[0], on.y[0], on.z[0]) == pytest.approx((10, 10, 0), abs=0.2)


def test_the_nearest_robot_gets_a_task_and_each_task_is_given_once():
    play = Play(stage(units(3, starts=[(10, 10), (40, 40), (80, 80)])))
    bid = {"task_id": "person", "to": (35.0, 35.0, 0.0)}
    play.start("bid", [0, 1, 2], **bid).run(5)
    assert play.outcomes() == ["aborted", "succeeded", "aborted"]
    play.start("bid", [0], **bid).start("bid", [2], **{**bid, "task_id": "other"}).run(5)
    assert play.outcomes() == ["aborted", "succeeded", "succeeded"]
