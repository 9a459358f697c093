"""Physics of robots: falls, hovering, contacts and drives, and machines as in other worlds."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.physics.motion import PhysicalMotion
from swarmdsl.execution.simulate.inputs.choose_space import choose_space
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND, SECOND
from swarmdsl.execution.simulate.scenario.scenario import Robot, Scenario
from swarmdsl.execution.space.flat import FlatSpace
from swarmdsl.execution.space.layout import Body, Layout, Unit
from swarmdsl.execution.space.shapes import Edge, Round
from swarmdsl.execution.space.stage import Stage
from swarmdsl.ir import ModelUse, Point, Wind

from ..worlds import Played, changed, numbers, system_of

FLYER = Body(radius=0.3, mass=1.5, speed=5.0, climb=2.0)
ROVER = Body(radius=0.3, mass=8.0, speed=1.5)
ALL = slice(None)


def stage_of(
    *bodies: tuple[Body, float, float],
    edges: tuple[Edge, ...] = (),
    rounds: tuple[Round, ...] = (),
    winds: tuple[Wind, ...] = (),
    size: tuple[float, ...] | None = (40.0, 40.0, 30.0),
    step: int = 100 * MILLISECOND,
) -> Stage:
    units = tuple(
        Unit(Robot(f"r[{number}]", "r", "R", number, len(bodies)), body, start=Point(x, y))
        for number, (body, x, y) in enumerate(bodies)
    )
    layout = Layout(units, size, edges=edges, rounds=rounds, winds=winds, step=step)
    return Stage(layout, [1], PhysicalMotion)


def go(stage: Stage, seconds: float, velocity: tuple[float, float, float] = (0, 0, 0)) -> None:
    for _ in range(round(seconds / stage.dt)):
        stage.ticks += 1
        stage.wanted_x[:], stage.wanted_y[:], stage.wanted_z[:] = velocity
        stage.move(ALL)


def fly_to(stage: Stage, x: float, y: float, z: float, seconds: float) -> None:
    who = np.arange(stage.rows)
    place = (np.full(stage.rows, each) for each in (x, y, z))
    x_, y_, z_ = place
    for _ in range(round(seconds / stage.dt)):
        stage.ticks += 1
        stage.steer(who, x_, y_, z_, stage.speed, stage.dt)
        stage.move(ALL)


def test_a_robot_without_motors_falls_freely() -> None:
    stage = stage_of((FLYER, 20, 20), step=20 * MILLISECOND)
    fly_to(stage, 20, 20, 20, 20)
    high, fast = float(stage.z[0]), float(stage.vz[0])
    assert high == pytest.approx(20, abs=0.05)
    stage.alive[0] = False
    for number in range(1, 76):
        go(stage, stage.dt)
        t = number * stage.dt
        assert stage.z[0] - high == pytest.approx(fast * t - 9.81 * t * t / 2, abs=0.04)
    assert stage.vz[0] == pytest.approx(-9.81 * 1.5, abs=0.05)
    go(stage, 3)
    assert stage.z[0] == pytest.approx(0, abs=0.02)


def test_a_robot_hovers_where_it_is_in_wind() -> None:
    stage = stage_of((FLYER, 20, 20), winds=(Wind(3.0, 0.5, 30 * SECOND),))
    fly_to(stage, 20, 20, 5, 20)
    assert math.dist((20, 20, 5), (stage.x[0], stage.y[0], stage.z[0])) < 0.05
    fly_to(stage, 20, 20, 5, 20)
    farthest = 0.0
    for _ in range(200):
        fly_to(stage, 20, 20, 5, stage.dt)
        farthest = max(farthest, math.dist((20, 20, 5), (stage.x[0], stage.y[0], stage.z[0])))
    assert farthest < 0.05


def test_wind_that_is_faster_than_a_robot_carries_it_off() -> None:
    stage = stage_of((FLYER, 20, 20), winds=(Wind(15.0, 0.0, 10 * SECOND),), size=None)
    fly_to(stage, 20, 20, 5, 10)
    fly_to(stage, 20, 20, 5, 5)
    assert stage.x[0] > 30
    assert stage.vx[0] == pytest.approx(15 - 5, abs=0.3)  # through the air at its greatest speed
    assert stage.z[0] == pytest.approx(5, abs=0.5)


def test_a_robot_at_its_greatest_speed_and_climb() -> None:
    stage = stage_of((FLYER, 2, 20), size=None)
    go(stage, 4, (0, 0, 9))
    assert stage.vz[0] == pytest.approx(2, abs=0.05)
    go(stage, 4, (9, 0, 0))
    assert stage.vx[0] == pytest.approx(5, abs=0.1)
    assert (stage.heading_x[0], stage.heading_y[0]) == pytest.approx((1, 0), abs=0.01)


@pytest.mark.parametrize("body", [FLYER, ROVER], ids=["flyer", "rover"])
def test_no_robot_passes_a_wall(body: Body) -> None:
    wall = Edge(10, 0, 10, 40, 0, 9, True, 0)
    stage = stage_of((body, 5, 20), edges=(wall,))
    if body.climb:
        fly_to(stage, 5, 20, 3, 6)
    touched = False
    for _ in range(80):
        go(stage, stage.dt, (body.speed, 0, 0))
        touched |= bool(stage.touched[0])
        assert stage.x[0] < 10 - body.radius + 0.03
    assert touched
    go(stage, 4, (-body.speed / 2, 0, 0))
    assert stage.x[0] < 9
    assert not stage.touched[0]


def test_a_robot_flies_above_a_wall_and_an_obstacle() -> None:
    wall, silo = Edge(10, 0, 10, 40, 0, 2, True, 0), Round(20, 20, 3, 4)
    stage = stage_of((FLYER, 5, 20), edges=(wall,), rounds=(silo,))
    fly_to(stage, 5, 20, 5, 6)
    fly_to(stage, 30, 20, 5, 12)
    assert stage.x[0] == pytest.approx(30, abs=0.1)
    fly_to(stage, 20, 20, 5, 6)
    stage.alive[0] = False
    go(stage, 3)
    assert stage.z[0] == pytest.approx(4, abs=0.02)  # it lies on the silo


def test_nobody_leaves_the_environment() -> None:
    stage = stage_of((ROVER, 38, 20), (FLYER, 38, 30))
    go(stage, 6, (3, 0, 0.5))
    assert (stage.x <= 40 - 0.3 + 0.03).all()
    assert stage.touched.all()


@pytest.mark.parametrize("body", [FLYER, ROVER], ids=["flyer", "rover"])
def test_robots_do_not_overlap(body: Body) -> None:
    stage = stage_of((body, 10, 20), (body, 16, 20.1))
    if body.climb:
        go(stage, 2, (0, 0, 1))
    met = False
    for _ in range(60):
        for row, sign in ((0, 1), (1, -1)):
            stage.wanted_x[row], stage.wanted_y[row] = sign * body.speed / 2, 0.0
            stage.wanted_z[row] = 0.0
        stage.ticks += 1
        stage.move(ALL)
        flat = float(np.hypot(stage.x[0] - stage.x[1], stage.y[0] - stage.y[1]))
        assert flat > 0.6 - 0.03 or abs(stage.z[0] - stage.z[1]) > 0.1
        met |= bool(stage.touched.all())
    assert met


def test_robots_that_start_at_one_place_are_put_beside_each_other() -> None:
    stage = stage_of(*[(ROVER, 20, 20)] * 5)
    one, other = np.triu_indices(5, 1)
    apart = np.hypot(stage.x[one] - stage.x[other], stage.y[one] - stage.y[other])
    assert (apart > 0.6).all()
    assert (np.hypot(stage.x - 20, stage.y - 20) < 3).all()
    before = stage.x.copy(), stage.y.copy()
    go(stage, 2)
    assert (np.hypot(stage.x - before[0], stage.y - before[1]) < 0.01).all()


def test_a_drive_reaches_its_goal_within_its_limits() -> None:
    stage = stage_of((ROVER, 5, 5))
    fastest, turned = 0.0, 0.0
    heading = 0.0
    for _ in range(300):
        fly_to(stage, 10, 15, 0, stage.dt)
        fastest = max(fastest, float(np.hypot(stage.vx[0], stage.vy[0])))
        now = math.atan2(stage.heading_y[0], stage.heading_x[0])
        turned, heading = max(turned, abs(now - heading) / stage.dt), now
        if math.hypot(stage.x[0] - 10, stage.y[0] - 15) < 0.1:
            break
    assert math.hypot(stage.x[0] - 10, stage.y[0] - 15) < 0.1
    assert 1.4 < fastest < 1.5 * 1.02
    assert turned < ROVER.turn
    assert stage.z[0] == 0
    # It cannot be faster, and is not much slower.
    least = math.hypot(5, 10) / 1.5
    assert least < stage.ticks[0] * stage.dt < least + 4


def test_a_drive_cannot_go_sideways() -> None:
    stage = stage_of((ROVER, 20, 20))
    go(stage, 0.1, (0, 1, 0))
    assert stage.y[0] - 20 < 0.001
    go(stage, 2, (0, 1, 0))
    assert stage.heading_y[0] > 0.99
    assert stage.y[0] > 20.5


# ---- machines

BODY = numbers(radius=0.3, mass=8, speed=2)


def go_to(x: float, y: float) -> Scenario:
    arguments = {"to": (x, y, 0.0)}
    return Scenario(functions={("walk", ""): {"model": "go_to", "arguments": arguments}})


def ends(played: Played) -> list[object]:
    return [(line["member"], line["event"], line["configuration"]) for line in played.lines]


def test_a_machine_does_the_same_in_all_worlds(tmp_path: Path) -> None:
    system = changed(
        system_of(tmp_path, robots=2), member={"body": BODY}, environment={"size": None}
    )
    played = {
        kind: Played(system, scenario=go_to(12, 0), kind=kind, until=30)
        for kind in ("abstract", "flat", "physics")
    }
    assert ends(played["flat"])[:2] == ends(played["abstract"])[:2]
    moved = played["flat"].events("do.Walk.succeeded")
    (first,) = played["physics"].events("do.Walk.succeeded")
    # In physics, two robots cannot be in one place: the second one is stopped.
    assert len(moved) == 2
    assert first["at"] == pytest.approx([12, 0, 0], abs=0.1)
    (stopped,) = played["physics"].events("do.Walk.aborted")
    assert math.dist(stopped["at"], first["at"]) > 0.55
    # All is at rest some time after that.
    assert played["physics"].ending is played["flat"].ending
    assert played["physics"].world.clock.now < 15 * SECOND


def test_a_run_is_the_same_again_and_beside_others(tmp_path: Path) -> None:
    system = changed(
        system_of(tmp_path, robots=3),
        member={"body": numbers(radius=0.3, mass=1.5, speed=5, climb=1)},
        environment={"winds": (Wind(2.0, 1.0, 2 * SECOND),)},
        model=ModelUse("random_walk", numbers(leg=5, height=3)),
    )
    once, again, other = (Played(system, seed, 8, kind="physics") for seed in (3, 3, 4))

    def places(played: Played) -> list[object]:
        return [played.space.at(robot) for robot in played.world.robots]

    assert once.lines == again.lines
    assert places(once) == places(again) != places(other)
    together = Stage(once.space._stage.layout, [4, 3], PhysicalMotion)
    alone = Stage(once.space._stage.layout, [3], PhysicalMotion)
    for stage in (together, alone):
        go(stage, 2, (1, 1, 1))
    assert together.x[3:].tolist() == alone.x.tolist()


def test_a_lost_robot_falls_and_flies_again_when_it_comes_back(tmp_path: Path) -> None:
    system = changed(
        system_of(tmp_path, robots=1),
        role={"start": Point(20, 20)},
        member={"body": numbers(radius=0.3, mass=1.5, speed=5, climb=2)},
        model=ModelUse("random_walk", numbers(leg=5, height=8)),
    )
    played = Played(system, 3, 8, kind="physics")
    space, robot = played.space, played.robot()
    assert isinstance(space, FlatSpace)
    assert space.at(robot)[2] > 7
    space.lose(robot)
    stage = space._stage
    stage.move(ALL)
    assert 6 < stage.z[0] < 8
    for _ in range(30):
        stage.move(ALL)
    assert stage.z[0] < 0.3  # it may lie on its edge
    space.restore(robot)
    for _ in range(30):
        stage.wanted_z[0] = 1.0
        stage.move(ALL)
    assert stage.z[0] > 1.5


def test_bodies_without_mass_are_reported(tmp_path: Path) -> None:
    system = changed(system_of(tmp_path), member={"body": numbers(mass=0, radius=0.3)})
    report = Diagnostics()
    (swarm,) = system.swarms
    choose_space("physics", Subject(swarm.name, system, swarm), Scenario(), report)
    (told,) = report
    assert (
        told.message == "`mass` of the body of member `Rover` is 0: physics needs 0.001 kg or more"
    )
