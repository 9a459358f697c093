"""Functions on a stage: what each is for, its limits, and the ways in which it fails."""

import numpy as np
import pytest
from tests.space.stages import (
    FLYER,
    WALKER,
    Play,
    battery,
    box,
    disc,
    stage,
    things,
    units,
    wall,
)

from swarmdsl.execution.engine import ExecutionError
from swarmdsl.execution.space.functions.catalog import CLASSES
from swarmdsl.execution.space.functions.form_up import places
from swarmdsl.execution.space.layout import Eye
from swarmdsl.execution.space.messages import path_in
from swarmdsl.execution.space.setting import Kind, Use
from swarmdsl.ir.function_models import MODELS


def _eye(kind, reach=20.0, **more):
    return (Eye(kind, reach, rate=10.0, **more),)


def test_the_catalogue_and_the_classes_are_the_same():
    assert set(CLASSES) == set(MODELS)


# ---- flight


def test_taking_off_takes_as_long_as_the_climb():
    play = Play(stage(units(1, FLYER))).start("take_off", [0], height=10.0).run(60)
    assert play.stage.z[0] == pytest.approx(10.0, abs=0.05)
    assert play.ended[0][0] == "succeeded"
    assert play.ended[0][1] == pytest.approx(10.0 / FLYER.climb, abs=0.2)


def test_what_cannot_fly_does_not_take_off():
    play = Play(stage(units(1, WALKER))).start("take_off", [0]).run(5)
    assert play.outcomes() == ["aborted"]
    assert play.stage.z[0] == 0


def test_nobody_climbs_through_the_ceiling():
    play = Play(stage(units(2, FLYER), size=(50.0, 50.0, 8.0)))
    play.start("take_off", [0], height=9.0).start("take_off", [1], height=8.0).run(20)
    assert play.outcomes() == ["aborted", "succeeded"]
    assert play.stage.z.max() <= 8.0


def test_landing_ends_on_the_ground_where_it_began():
    play = Play(stage(units(1, FLYER, starts=[(30, 40)]))).start("take_off", [0], height=6.0)
    play.run(20).start("land", [0]).run(20)
    on = play.stage
    assert (on.x[0], on.y[0], on.z[0]) == pytest.approx((30, 40, 0))
    assert play.outcomes() == ["succeeded"]


def test_hovering_lasts_as_long_as_said():
    play = Play(stage(units(1, FLYER))).start("hover", [0], time=7.5).run(20)
    assert play.ended[0] == ("succeeded", pytest.approx(7.5, abs=0.15))


# ---- ways


def test_a_path_is_followed_through_all_its_places():
    path = ((10.0, 0.2, 0.0), (10.0, 10.0, 0.0), (0.2, 10.0, 0.0))
    seen = []
    play = Play(stage(units(1, WALKER, starts=[(0.2, 0.2)])))
    play.start("follow_path", [0], path=path)
    play.run(100, lambda: seen.append((play.stage.x[0], play.stage.y[0])))
    assert play.outcomes() == ["succeeded"]
    for x, y, _ in path:
        assert min(np.hypot(x - one, y - other) for one, other in seen) <= 0.1
    assert play.ended[0][1] == pytest.approx(9.8 * 3 / WALKER.speed, rel=0.05)


def test_a_path_through_a_wall_ends_at_it():
    play = Play(stage(units(1, starts=[(1, 5)]), edges=wall((5, 0), (5, 10))))
    play.start("follow_path", [0], path=((9.0, 5.0, 0.0),)).run(60)
    assert play.outcomes() == ["aborted"]
    assert play.stage.x[0] < 5


def test_no_path_is_none():
    assert Play(stage(units(1))).start("follow_path", [0]).run(1).outcomes() == ["aborted"]


# ---- targets


def test_tracking_keeps_the_distance_to_a_target_that_is_carried_about():
    of = units(1, FLYER, starts=[(10, 10)], eyes=_eye("person", 30.0))
    of += units(1, WALKER, "guide", starts=[(12, 10)])
    play = Play(stage(of, targets=(things("person", (12.0, 10.0)),)))
    play.start("grasp", [1], target="person", time=0.0).run(1)
    play.start("carry", [1], to=(60.0, 40.0, 0.0)).start("track", [0], distance=3.0, time=40.0)
    play.run(40)
    on = play.stage
    gap = np.hypot(on.targets.x[0] - on.x[0], on.targets.y[0] - on.y[0])
    assert play.ended[0][0] == "succeeded"
    assert gap == pytest.approx(3.0, abs=0.5)
    assert on.x[0] > 20


def test_a_target_out_of_sight_is_lost():
    of = units(1, FLYER, starts=[(10, 10)], eyes=_eye("person", 5.0))
    play = Play(stage(of, targets=(things("person", (80.0, 80.0)),)))
    play.start("track", [0], lost=4.0).run(60)
    assert play.ended[0] == ("aborted", pytest.approx(4.0, abs=0.2))


def test_a_target_that_is_not_where_it_was_said_to_be_is_lost():
    of = units(1, FLYER, starts=[(10, 10)], eyes=_eye("person", 5.0))
    play = Play(stage(of, targets=(things("person", (80.0, 80.0)),)))
    play.start("track", [0], to=(20.0, 10.0, 0.0), lost=10.0).run(60)
    assert play.outcomes() == ["aborted"]
    assert play.stage.x[0] == pytest.approx(20, abs=0.1)


def test_sensing_ends_when_a_target_of_the_kind_is_in_sight():
    of = units(3, starts=[(10, 10), (50, 50), (10, 12)], eyes=_eye("weed", 5.0))
    play = Play(stage(of, targets=(things("weed", (12.0, 10.0)), things("stone", (52.0, 50.0)))))
    play.start("sense", [0, 1], target="weed", time=6.0)
    play.start("sense", [2], target="weed[0]", time=6.0).run(30)
    assert play.outcomes() == ["succeeded", "aborted", "succeeded"]
    assert play.functions["sense"].result(0).id == "weed[0]"
    assert play.ended[1][1] == pytest.approx(6.0, abs=0.2)


def test_a_target_is_grasped_carried_and_put_down():
    play = Play(stage(units(1, starts=[(10, 10)]), targets=(things("box", (10.3, 10.0)),)))
    play.start("grasp", [0], target="box").run(10)
    assert play.ended[0] == ("succeeded", pytest.approx(2.0, abs=0.2))
    play.start("carry", [0], to=(20.0, 30.0, 0.0)).run(60)
    play.start("place", [0]).run(10)
    on = play.stage
    assert play.outcomes() == ["succeeded"]
    assert (on.targets.x[0], on.targets.y[0]) == pytest.approx((20, 30), abs=0.2)
    assert on.targets.carrier[0] == -1
    play.start("go_to", [0], to=(50.0, 50.0, 0.0)).run(60)
    assert on.targets.x[0] == pytest.approx(20, abs=0.2)


def test_what_is_not_in_reach_is_not_grasped():
    play = Play(stage(units(2, starts=[(10, 10), (10, 10.1)]), targets=(things("box", (11, 10)),)))
    play.start("grasp", [0], reach=0.9).start("grasp", [1], target="bag", reach=5.0).run(10)
    assert play.outcomes() == ["aborted", "aborted"]


def test_of_two_robots_one_gets_the_only_box():
    play = Play(stage(units(2, starts=[(10, 10), (10, 10.1)]), targets=(things("box", (10, 10)),)))
    play.start("grasp", [1]).start("grasp", [0]).run(10)
    assert play.outcomes() == ["succeeded", "aborted"]
    play.start("grasp", [0]).run(10)
    assert play.ended[0][0] == "aborted"  # its hand is full


def test_nothing_is_carried_or_put_down_by_an_empty_hand():
    play = Play(stage(units(2)))
    play.start("carry", [0], to=(1.0, 1.0, 0.0)).start("place", [1]).run(10)
    assert play.outcomes() == ["aborted", "aborted"]


def test_spraying_treats_what_is_under_the_jet_until_the_tank_is_empty():
    weeds = things("weed", (10.5, 10.0), (10.0, 10.9), (13.0, 10.0))
    play = Play(stage(units(1, starts=[(10, 10)]), targets=(weeds,)))
    play.start("spray", [0], target="weed", amount=0.4, time=3.0).run(10)
    function = play.functions["spray"]
    assert function.result(0) == {"left": pytest.approx(0.6), "treated": 2}
    assert play.stage.targets.taken.tolist() == [True, True, False]
    play.start("spray", [0], amount=0.4).run(20)
    assert function.result(0) == {"left": pytest.approx(0.2), "treated": 0}
    assert play.start("spray", [0], amount=0.4).run(20).outcomes() == ["aborted"]
    play.start("refill", [0], time=5.0).run(20).start("spray", [0], amount=0.4).run(20)
    assert play.outcomes() == ["succeeded"]


# ---- chargers


def test_robots_dock_one_at_a_time_and_leave_for_the_next():
    chargers = things("charger", (50.0, 50.0))
    of = units(3, FLYER, starts=[(40, 50), (50, 40), (60, 60)], battery=battery(1e6))
    play = Play(stage(of, targets=(chargers,)))
    play.start("take_off", [0, 1, 2], height=5.0).run(10)
    play.start("dock", [0, 1, 2])
    on, seen, order = play.stage, [], []

    def look():
        gap = np.hypot(on.x - 50, on.y - 50)
        seen.append(int(((gap < 0.5) & (on.z < 1)).sum()))
        for row in set(play.ended) - set(order):
            order.append(row)
            play.start("go_to", [row], to=(90.0, 10.0 * row, 0.0), height=5.0)

    play.run(120, look)
    assert sorted(order) == [0, 1, 2]
    assert max(seen) == 1


def test_a_dead_robot_does_not_keep_its_charger():
    of = units(2, starts=[(50, 50), (52, 50)])
    play = Play(stage(of, targets=(things("charger", (50.0, 50.0)),)))
    play.start("dock", [0]).run(5).start("dock", [1]).run(20)
    assert 1 not in play.ended
    play.stage.alive[0] = False
    play.run(20)
    assert play.ended[1][0] == "succeeded"


def test_giving_up_on_the_way_frees_the_charger():
    of = units(2, starts=[(50, 80), (52, 50)])
    play = Play(stage(of, targets=(things("charger", (50.0, 50.0)),)))
    play.start("dock", [0]).run(1).start("dock", [1]).run(1)
    play.functions["dock"].stop(0)
    play.run(10)
    assert play.ended[1][0] == "succeeded"


def test_a_charger_with_power_charges_who_stays_there():
    """It gets 30 W less the 4 W that it uses, until it is full or has left."""
    of = units(1, starts=[(52, 50)], battery=battery(1000.0, idling=4.0, moving=10.0))
    play = Play(stage(of, targets=(things("charger", (50.0, 50.0)),)))
    play.stage.energy[0] = 500.0
    play.start("dock", [0], power=30.0).run(5)
    assert play.outcomes() == ["succeeded"]
    before = play.stage.energy[0]
    play.start("hover", [0], time=10.0).run(20)
    assert play.stage.energy[0] - before == pytest.approx(10 * (30 - 4))
    play.start("hover", [0], time=15.0).run(20)
    assert play.stage.energy[0] == pytest.approx(1000.0, abs=2 * play.stage.dt * 4)
    play.start("go_to", [0], to=(60.0, 50.0, 0.0)).run(3)
    assert play.stage.energy[0] == pytest.approx(1000.0 - 3 * 10, abs=5)


# ---- driving


def test_driving_on_and_back_leads_to_where_it_began():
    play = Play(stage(units(1, WALKER, starts=[(20, 20)])))
    play.start("drive", [0], distance=2.0, speed=0.5).run(6)
    assert (play.stage.x[0], play.stage.y[0]) == pytest.approx((22.0, 20.0))
    assert play.ended[0][1] == pytest.approx(2.0 / 0.5, abs=0.2)
    play.start("drive", [0], distance=-2.0, speed=0.5).run(6)
    assert (play.stage.x[0], play.stage.y[0]) == pytest.approx((20.0, 20.0))
    assert (play.stage.heading_x[0], play.stage.heading_y[0]) == pytest.approx((1.0, 0.0))


def test_an_arc_ends_on_its_circle_and_looks_along_it():
    """A quarter of a circle of 2 m to the left leads 2 m on and 2 m aside, and looks left."""
    play = Play(stage(units(1, WALKER, starts=[(20, 20)])))
    play.start("drive", [0], distance=np.pi, turn=np.pi / 2, speed=0.5).run(10)
    assert (play.stage.x[0], play.stage.y[0]) == pytest.approx((22.0, 22.0), abs=0.01)
    assert (play.stage.heading_x[0], play.stage.heading_y[0]) == pytest.approx((0.0, 1.0))


def test_a_turn_on_the_spot_takes_the_time_of_its_rate():
    play = Play(stage(units(1, WALKER, starts=[(20, 20)])))
    play.start("drive", [0], turn=-np.pi, rate=0.5).run(10)
    assert play.ended[0][1] == pytest.approx(np.pi / 0.5, abs=0.2)
    assert (play.stage.x[0], play.stage.y[0]) == (20.0, 20.0)
    assert (play.stage.heading_x[0], play.stage.heading_y[0]) == pytest.approx((-1.0, 0.0))


def test_driving_ends_at_what_is_in_the_way():
    play = Play(stage(units(1, WALKER, starts=[(20, 20)]), edges=box((22, 18), (23, 22))))
    play.start("drive", [0], distance=5.0).run(10)
    assert play.outcomes() == ["aborted"]


def test_without_chargers_nobody_docks():
    assert Play(stage(units(1))).start("dock", [0]).run(1).outcomes() == ["aborted"]


def test_charging_takes_the_energy_over_the_power():
    of = units(1, starts=[(50, 50)], battery=battery(36_000, idling=4.0))
    play = Play(stage(of, targets=(things("charger", (50.0, 50.0)),)))
    play.stage.energy[0] = 12_000
    play.start("charge", [0], power=104.0).run(1000)
    assert play.ended[0] == ("succeeded", pytest.approx(240.0, rel=0.01))
    play.stage.energy[0] = 12_000
    play.start("charge", [0], power=104.0, level=0.5).run(1000)
    assert play.stage.energy[0] == pytest.approx(18_000, rel=0.01)


def test_a_swapped_battery_is_full():
    of = units(1, starts=[(50, 50)], battery=battery(36_000))
    play = Play(stage(of, targets=(things("charger", (50.0, 50.0)),)))
    play.stage.energy[0] = 12_000
    play.start("charge", [0], time=40.0).run(39)
    assert play.stage.energy[0] == 12_000
    play.run(2)
    assert play.stage.energy[0] == 36_000
    assert play.outcomes() == ["succeeded"]


def test_nobody_charges_away_from_a_charger_or_at_a_taken_one():
    of = units(3, starts=[(50, 50), (50.1, 50), (60, 60)], battery=battery(100))
    play = Play(stage(of, targets=(things("charger", (50.0, 50.0)),)))
    play.stage.energy[:] = 1
    play.start("charge", [0, 1, 2], power=10.0).run(60)
    assert play.outcomes() == ["succeeded", "aborted", "aborted"]


# ---- groups


def test_robots_form_up():
    rows = list(range(5))
    starts = [(20, 20), (30, 22), (25, 28), (22, 30), (28, 25)]
    play = Play(stage(units(5, starts=starts)))
    play.start("form_up", rows, shape="wedge", spacing=2.0, heading=np.pi / 2).run(60)
    on = play.stage
    assert play.outcomes() == ["succeeded"] * 5
    ahead, aside = places("wedge", 5, 2.0).T
    assert on.x == pytest.approx(25 - aside, abs=0.15)
    assert on.y == pytest.approx(25 + ahead, abs=0.15)


def test_dispersed_robots_are_clear_of_each_other():
    starts = [(50 + 0.1 * index, 50 + 0.07 * index**2) for index in range(8)]
    play = Play(stage(units(8, starts=starts))).start("disperse", range(8), distance=3.0).run(120)
    on = play.stage
    gaps = np.hypot(on.x[:, None] - on.x, on.y[:, None] - on.y) + 100 * np.eye(8)
    assert play.outcomes() == ["succeeded"] * 8
    assert gaps.min() >= 3.0 - 2 * WALKER.speed * on.dt


def test_a_flock_flies_the_same_way_and_stays_together():
    chance = np.random.default_rng(7)
    starts = 40 + 10 * chance.random((10, 2))
    play = Play(stage(units(10, FLYER, starts=starts), size=(4000.0, 4000.0)))
    on = play.stage
    angle = chance.random(10) * 2
    on.heading_x[:], on.heading_y[:] = np.cos(angle), np.sin(angle)
    play.start("flock", range(10), speed=2.0, range=30.0, time=60.0).run(100)
    assert play.outcomes() == ["succeeded"] * 10
    assert np.hypot(on.heading_x.mean(), on.heading_y.mean()) > 0.95
    gaps = np.hypot(on.x[:, None] - on.x, on.y[:, None] - on.y)
    assert gaps.max() < 30


def test_a_robot_that_has_lost_its_flock_gives_up():
    play = Play(stage(units(3, starts=[(10, 10), (80, 80), (81, 80)])))
    play.start("flock", range(3), lost=5.0, time=8.0, range=6.0).run(60)
    assert play.ended[0] == ("aborted", pytest.approx(5.0, abs=0.2))
    assert [play.ended[row][0] for row in (1, 2)] == ["succeeded"] * 2


def test_a_flock_turns_round_at_the_border():
    play = Play(stage(units(5, FLYER, starts=[(10 + i, 10) for i in range(5)]), size=(20.0, 20.0)))
    seen = []
    play.start("flock", range(5), speed=5.0)
    play.run(60, lambda: seen.append(play.stage.x[0]))
    assert max(seen) > 15
    assert min(seen[100:]) < 10


def test_aggregated_robots_rest_together():
    play = Play(stage(units(8), size=(5.0, 5.0)))
    play.start("aggregate", range(8), range=1.5, leg=2.0, size=3)
    on = play.stage
    while not play.ended:
        play.step()
    (row, *_) = play.ended
    near = np.hypot(on.x - on.x[row], on.y - on.y[row]) <= 1.5
    assert play.ended[row][0] == "succeeded"
    assert near.sum() >= 3
    # Who rests stands still.
    still = [(on.x[each], on.y[each]) for each in range(8) if on.vx[each] == on.vy[each] == 0]
    assert len(still) >= 3


def test_avoiding_ends_clear_of_walls_discs_borders_and_robots():
    starts = [(10, 10.5), (50.5, 50), (0.4, 90), (80, 80), (80.5, 80)]
    shapes = {"edges": wall((5, 10), (15, 10)), "rounds": (disc(50, 47.5, 2),)}
    play = Play(stage(units(5, starts=starts), **shapes)).start("avoid", range(5), distance=2.0)
    play.run(60)
    on = play.stage
    assert play.outcomes() == ["succeeded"] * 5
    assert on.y[0] - 10 >= 2.0
    assert np.hypot(on.x[1] - 50, on.y[1] - 47.5) >= 4.0
    assert on.x[2] >= 2.0
    assert np.hypot(on.x[3] - on.x[4], on.y[3] - on.y[4]) >= 2.0


def test_where_there_is_no_room_avoiding_is_aborted():
    cell = box((49, 49), (51, 51))
    play = Play(stage(units(1, starts=[(50, 50)]), edges=cell))
    assert play.start("avoid", [0], distance=3.0, time=5.0).run(60).outcomes() == ["aborted"]


# ---- arguments


ROUTE = {"route": {"poses": [{"pose": {"position": {"x": 1, "y": 2, "z": 0}}}, {"x": 3, "y": 4}]}}


def test_a_path_is_the_first_list_of_places_in_a_goal():
    assert path_in({"id": "a", "names": ["b"], **ROUTE}) == ((1, 2, 0), (3, 4, 0))
    assert path_in({"names": ["b"], "none": [], "x": 3}) is None
    assert path_in([{"x": 1, "y": 2}, {"z": 3}]) is None


def test_arguments_come_from_the_goal_or_the_catalogue():
    kind = Kind("follow_path", MODELS["follow_path"].arguments, CLASSES["follow_path"])
    use = Use("go", kind, (), {})
    assert use.arguments(ROUTE)["path"] == ((1, 2, 0), (3, 4, 0))
    assert use.arguments({})["path"] is None
    with pytest.raises(ExecutionError, match="`path` is no path"):
        Use("go", kind, (("path", lambda data, event: 3),), {}).arguments({})


def test_an_argument_with_choices_is_one_of_them():
    kind = Kind("flock", MODELS["flock"].arguments, CLASSES["flock"])
    good, bad = (
        Use("fly", kind, (("rule", lambda data, event, word=word: word),), {})
        for word in ("vicsek", "Vicsek")
    )
    assert good.arguments({})["rule"] == "vicsek"
    with pytest.raises(ExecutionError, match="not `reynolds` or `vicsek`"):
        bad.arguments({})


def test_a_robot_tracks_its_own_target_among_several():
    of = units(1, FLYER, starts=[(10, 10)], eyes=_eye("person", 60.0))
    people = things("person", (12.0, 10.0), (30.0, 30.0), (12.0, 12.0))
    play = Play(stage(of, targets=(people,)))
    play.start("track", [0], target="person[1]", lost=5.0, time=30.0).run(60)
    on = play.stage
    assert play.outcomes() == ["succeeded"]
    assert (on.x[0], on.y[0]) == pytest.approx((30, 30), abs=0.1)
    assert play.functions["track"].result(0).id == "person[1]"


def test_a_walk_ends_where_it_sees_its_target():
    of = units(2, WALKER, starts=[(10, 10), (90, 90)], eyes=_eye("exit", 4.0))
    play = Play(stage(of, targets=(things("exit", (20.0, 10.0)), things("box", (85.0, 85.0)))))
    play.start("random_walk", [0], target="exit", leg=20.0)
    play.start("random_walk", [1], target="door", time=20.0).run(4000)
    assert play.outcomes() == ["succeeded", "aborted"]
    found = play.functions["random_walk"].result(0)
    assert found.id == "exit[0]"
    assert found.place == pytest.approx((20, 10, 0))


def test_a_target_in_the_goal_is_the_one_that_is_tracked():
    kind = Kind("track", MODELS["track"].arguments, CLASSES["track"])
    assert Use("follow", kind, (), {}).arguments({"target": "person[2]"})["target"] == "person[2]"
    assert Use("follow", kind, (), {}).arguments({"target": ""})["target"] is None


def test_a_search_for_new_targets_goes_on_where_it_was():
    of = units(1, FLYER, starts=[(1, 1)], eyes=_eye("person", 4.0))
    people = things("person", (2.0, 30.0), (58.0, 30.0))
    play = Play(stage(of, size=(60.0, 60.0), targets=(people,)))
    names, times = [], []
    for _ in range(3):
        play.start("coverage", [0], width=6.0, target="person", which="new").run(600)
        if play.outcomes() == ["succeeded"]:
            names.append(play.functions["coverage"].result(0).id)
        times.append(play.ended[0][1])
    assert names == ["person[0]", "person[1]"]
    assert play.outcomes() == ["aborted"]
    # All lanes once: 10 of 60 m, and between them.
    assert times[-1] == pytest.approx((10 * 54 + 9 * 6) / FLYER.speed, rel=0.1)
    play.start("coverage", [0], width=6.0, target="person").run(600)
    assert play.outcomes() == ["succeeded"]
