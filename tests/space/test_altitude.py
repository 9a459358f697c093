"""Altitude: how much of the ground sensors see, and what it costs."""

import numpy as np
import pytest
from tests.space.stages import FLYER, WALKER, Play, battery, stage, things, units

from swarmdsl.execution.space.layout import Eye

VIEW = np.pi / 2
RANGE = 10.0


def _flying(height, targets, view=VIEW):
    eyes = (Eye("person", RANGE, view=view, rate=10.0),)
    play = Play(stage(units(1, FLYER, starts=[(50, 50)], eyes=eyes), targets=(targets,)))
    play.start("take_off", [0], height=height).run(60)
    play.stage.targets.seen[:] = False  # what it has seen on its way up
    play.start("hover", [0], time=1.0).run(2)
    return play.stage


@pytest.mark.parametrize("height", [1.0, 3.0, 6.0, 9.0])
def test_a_robot_in_the_air_sees_a_cone_up_to_its_range(height):
    """The rim of the cone is at h tan(view/2), that of the sphere at the root of r^2 - h^2."""
    radius = min(height * np.tan(VIEW / 2), np.sqrt(RANGE**2 - height**2))
    ring = [(50 + radius + step, 50.0) for step in (-0.2, 0.2)]
    ring += [(50.0, 50 - radius - step) for step in (-0.2, 0.2)]
    on = _flying(height, things("person", *ring))
    assert on.targets.seen.tolist() == [True, False, True, False]


def test_above_its_range_it_sees_nothing():
    assert not _flying(11.0, things("person", (50, 50))).targets.seen.any()


def test_on_the_ground_it_looks_ahead():
    eyes = (Eye("person", RANGE, view=VIEW, rate=10.0),)
    ahead, behind = things("person", (55, 50)), things("person", (45, 50))
    for targets, seen in ((ahead, True), (behind, False)):
        play = Play(stage(units(1, WALKER, starts=[(50, 50)], eyes=eyes), targets=(targets,)))
        play.start("hover", [0], time=1.0).run(2)
        assert play.stage.targets.seen.tolist() == [seen]


def _flight(height, lane, seed):
    cell = battery(1e6, moving=150.0, hovering=120.0)
    eyes = (Eye("person", RANGE, view=VIEW, rate=5.0),)
    of = units(1, FLYER, starts=[(1, 1)], eyes=eyes, battery=cell)
    play = Play(stage(of, seeds=(seed,), size=(60.0, 60.0)))
    play.start("take_off", [0], height=height).run(60)
    play.stage.covering.is_wanted = True
    play.start("coverage", [0], width=lane, height=height).run(3000)
    assert play.outcomes() == ["succeeded"]
    return play


def test_a_higher_flight_needs_fewer_lanes_less_time_and_less_energy():
    """The lanes are as wide as the footprint: both cover all."""
    low, high = _flight(2.0, 4.0, 1), _flight(5.0, 10.0, 1)
    for each in (low, high):
        assert each.stage.covering.share(0) > 0.95
    assert high.ended[0][1] < low.ended[0][1] / 2
    assert high.stage.used[0] < low.stage.used[0]


def test_too_high_a_flight_misses_ground():
    """With the same lanes, the range leaves a smaller footprint: at 9.5 m the radius is 3.1 m."""
    best, high = _flight(5.0, 10.0, 1), _flight(9.5, 10.0, 1)
    assert high.stage.covering.share(0) < best.stage.covering.share(0) - 0.2


def test_a_climb_costs_more_the_higher_it_is():
    used = []
    for height in (5.0, 10.0, 20.0):
        cell = battery(1e6, moving=150.0)
        play = Play(stage(units(1, FLYER, battery=cell))).start("take_off", [0], height=height)
        used.append(play.run(60).stage.used[0])
    assert used == sorted(used)
    rises = np.diff(used)
    assert rises[1] == pytest.approx(2 * rises[0], rel=0.05)
