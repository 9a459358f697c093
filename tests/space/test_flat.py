"""The flat space: motion, functions, energy, radio and sight of robots in a run."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.simulate.machines.actors import actors
from swarmdsl.execution.simulate.scenario.durations import SECOND, Fixed
from swarmdsl.execution.simulate.scenario.scenario import Fault, Scenario
from swarmdsl.execution.simulate.world.line import as_json
from swarmdsl.execution.simulate.world.runner import run, run_by_steps
from swarmdsl.execution.simulate.world.world import World
from swarmdsl.execution.space.ensemble import Ensemble
from swarmdsl.ir import (
    Box,
    Disc,
    ModelUse,
    Obstacle,
    Point,
    RobotValues,
    Sight,
    System,
    Targets,
    Wall,
    Wind,
    Zone,
)

from .worlds import Played, changed, numbers, system_of

BODY = numbers(radius=0.3, speed=5)
WALK = ModelUse("random_walk", numbers(leg=20))


def go_to(x: float, y: float, **more: float) -> Scenario:
    arguments = {"to": (x, y, 0.0), **more}
    return Scenario(functions={("walk", ""): {"model": "go_to", "arguments": arguments}})


def at(system: System, x: float, y: float, **more: object) -> System:
    return changed(system, role={"start": Point(x, y)}, member={"body": BODY, **more})


def full(folder: Path, robots: int = 4) -> System:
    """A system with everything."""
    return changed(
        system_of(folder, robots=robots),
        environment={
            "targets": (Targets("person", 6),),
            "walls": (Wall((Point(0, 50), Point(40, 50), Point(40, 70)), 3.0),),
            "obstacles": (Obstacle("silo", Disc(Point(70, 30), 5.0)),),
            "zones": (Zone("village", Box(Point(20, 20), Point(30, 30))),),
            "winds": (Wind(2.0, 1.0, 10 * SECOND),),
        },
        member={
            "body": numbers(radius=0.3, speed=5, climb=1),
            "battery": numbers(capacity=5000, moving=100, hovering=80, idling=4),
            "radio": numbers(range=40, loss=0.3, through=0.5),
        },
        camera={
            "sights": (Sight("person", numbers(range=9, view=1.5, miss=0.3, wrong=0.01, rate=2)),)
        },
        model=WALK,
    )


def test_a_robot_goes_to_a_place_and_arrives_in_time(tmp_path: Path) -> None:
    played = Played(at(system_of(tmp_path, robots=1), 10, 20), scenario=go_to(70, 20))
    (arrived,) = played.events("do.Walk.succeeded")
    assert arrived["t"] == pytest.approx(60 / 5 * 1000, abs=100)
    assert arrived["at"] == pytest.approx([70, 20, 0], abs=0.1)
    assert arrived["data"]["target_pose"]["pose"]["position"]["x"] == pytest.approx(70, abs=0.1)
    assert played.space.measure("distance", "rover") == pytest.approx(60, abs=0.1)


def test_a_wall_stops_a_robot_and_aborts_its_function(tmp_path: Path) -> None:
    system = changed(
        at(system_of(tmp_path, robots=1), 10, 20),
        environment={"walls": (Wall((Point(50, 0), Point(50, 80))),)},
        role={"start": Point(10, 20)},
    )
    played = Played(system, scenario=go_to(70, 20))
    (aborted,) = played.events("do.Walk.aborted")
    assert 49 < aborted["at"][0] <= 49.7
    assert aborted["t"] == pytest.approx(40 / 5 * 1000, abs=200)


def test_no_robot_is_ever_in_an_obstacle(tmp_path: Path) -> None:
    system = changed(
        system_of(tmp_path, robots=6),
        environment={
            "walls": (Wall((Point(50, 0), Point(50, 60))),),
            "obstacles": (
                Obstacle("silo", Disc(Point(20, 20), 6.0)),
                Obstacle("barn", Box(Point(60, 10), Point(80, 30))),
            ),
        },
        member={"body": BODY},
        model=ModelUse("random_walk", numbers(leg=50)),
    )
    played = Played(system, until=0)
    subject, setting = played.subject, played.spaces.setting
    assert setting is not None
    ensemble = Ensemble(setting, [5])
    (space,), stage = ensemble.spaces, ensemble.stage
    assert stage.shapes.distances(stage.x, stage.y, stage.z).min() >= 0.3
    cast = actors(subject, subject.create_robots({}), Scenario(), Diagnostics())
    world = World(system, cast, Scenario(), 5, [], None, space)
    run(world, [], 120 * SECOND)
    nearest = stage.shapes.distances(stage.x, stage.y, stage.z)
    assert nearest.min() >= 0.3 - 1e-9
    assert not stage.shapes.inside(stage.x, stage.y).any()
    assert (stage.distance > 100).all()


def test_the_same_seed_gives_the_same_trace(tmp_path: Path) -> None:
    system = full(tmp_path)
    first, again, other = (Played(system, seed) for seed in (3, 3, 4))
    assert first.lines == again.lines
    assert first.lines != other.lines
    assert len(first.lines) > 30


def test_another_robot_changes_nothing_for_the_others(tmp_path: Path) -> None:
    def places(robots: int) -> list[object]:
        system = changed(system_of(tmp_path, robots=robots), member={"body": BODY}, model=WALK)
        played = Played(system, until=30)
        return [played.space.at(robot) for robot in played.world.robots]

    assert places(5)[:3] == places(3)


@pytest.mark.parametrize("size", [2, 5])
def test_runs_together_are_as_alone(tmp_path: Path, size: int) -> None:
    system = full(tmp_path)
    alone = [Played(system, seed, 40) for seed in range(size)]
    played = alone[0]
    ensemble = played.spaces.together(range(size))
    lines: list[list[object]] = [[] for _ in range(size)]
    steps = []
    for seed, space in enumerate(ensemble.spaces):
        cast = actors(played.subject, played.subject.create_robots({}), Scenario(), Diagnostics())
        hear = [lambda line, seed=seed: lines[seed].append(json.loads(as_json(line)))]
        world = World(system, cast, Scenario(), seed, hear, None, space)
        # They end at different times, and so are not always all due.
        steps.append((space, run_by_steps(world, [], (40 - seed) * SECOND)))
    while steps:
        still = []
        for space, each in steps:
            try:
                if not space.due:
                    next(each)
                still.append((space, each))
            except StopIteration:
                space.due = False
        steps = still
        if steps:
            ensemble.advance()
    for seed, one in enumerate(alone):
        assert lines[seed] == [line for line in one.lines if line["t"] <= (40 - seed) * 1000]


def test_an_empty_battery_loses_the_robot(tmp_path: Path) -> None:
    system = changed(
        system_of(tmp_path, robots=1),
        role={"start": Point(10, 10)},
        member={"body": BODY, "battery": numbers(capacity=1000, moving=100, idling=4)},
        model=ModelUse("random_walk"),
    )
    played = Played(system, until=200)
    tired = next(line for line in played.events("Low") if line["configuration"] == ["Tired"])
    assert tired["t"] == 6000  # the first reading below a half
    assert tired["data"]["percentage"] == pytest.approx(0.4)
    assert tired["data"]["charge"] == 0
    # Then it rests.
    (lost,) = played.events("fault.lost")
    assert lost["data"] == {"reason": "battery empty"}
    assert lost["t"] == pytest.approx(6000 + 400 / 4 * 1000, abs=200)


def test_radio_has_a_range(tmp_path: Path) -> None:
    text = """
swarm event Hello : std_msgs/String
endless statemachine Talking {
  initial Talk
  state Talk { after 1 s / send Hello -> Talk }
}
endless statemachine Hearing {
  initial Deaf
  state Deaf { on Hello -> Heard }
  state Heard { }
}
environment Field { size 100 m x 80 m }
member Talker { behavior Talking }
member Hearer { behavior Hearing }
swarm S {
  talker : Talker
  hearer : Hearer[3]
  environment Field
}
"""
    system = system_of(tmp_path, text)
    (swarm,) = system.swarms

    talker, hearer = swarm.roles
    places = [Point(30, 10), Point(65, 10), Point(10, 30)]
    robots = tuple(RobotValues(n, (), start=place) for n, place in enumerate(places))
    system = replace(
        system,
        members=tuple(replace(m, radio=numbers(range=30, through=0)) for m in system.members),
        environments=tuple(
            replace(e, walls=(Wall((Point(0, 20), Point(100, 20))),)) for e in system.environments
        ),
        swarms=(
            replace(
                swarm,
                roles=(replace(talker, start=Point(10, 10)), replace(hearer, robots=robots)),
            ),
        ),
    )
    played = Played(system, until=5)
    heard = {line["member"] for line in played.events("Hello")}
    assert heard == {"hearer[0]"}


def test_heartbeats_notice_who_goes_out_of_reach(tmp_path: Path) -> None:
    text = """
action demo_msgs/Go { goal { altitude : float64 } }
function walk : swarm { action "walk" : demo_msgs/Go }
endless statemachine Walking {
  initial Walk
  state Walk {
    do walk(altitude = 0)
    on member_lost -> Alone
    on succeeded -> Walk
    on aborted -> Walk
  }
  state Alone { on member_joined -> Walk }
}
environment Field { size 300 m x 80 m }
member Rover { behavior Walking }
swarm S {
  rover : Rover[2]
  environment Field
  heartbeat 1 s lost after 3 s
}
"""
    system = changed(
        system_of(tmp_path, text),
        role={"start": Point(10, 10)},
        member={"body": BODY, "radio": numbers(range=50)},
    )
    scenario = Scenario(
        functions={
            ("walk", "rover[0]"): {
                "model": "go_to",
                "arguments": {"to": (200.0, 10.0, 0.0)},
            }
        }
    )
    played = Played(system, scenario=scenario, until=60)
    lost = played.events("member_lost")
    assert {line["member"] for line in lost} == {"rover[0]", "rover[1]"}
    # 50 m at 5 m/s: last heard at 10 s.
    assert {line["t"] for line in lost} == {13000}


def test_a_camera_sees_a_target_and_tells_others(tmp_path: Path) -> None:
    system = changed(
        system_of(tmp_path, robots=2),
        environment={"targets": (Targets("person", 1, (Point(50, 10),)),)},
        role={"start": Point(10, 10)},
        member={"body": BODY},
        camera={"sights": (Sight("person", numbers(range=8, rate=2)),)},
    )
    scenario = Scenario(
        functions={
            ("walk", "rover[0]"): {"model": "go_to", "arguments": {"to": (90.0, 10.0, 0.0)}},
            ("walk", "rover[1]"): {"model": "go_to", "arguments": {"to": (10.0, 70.0, 0.0)}},
        }
    )
    played = Played(system, scenario=scenario)
    found, *_ = played.events("Found")
    assert found["member"] == "rover[1]"
    assert found["envelope"]["sender"] == "rover[0]"
    assert found["data"]["id"] == "person[0]"
    assert found["data"]["pose"]["pose"]["position"] == {"x": 50.0, "y": 10.0, "z": 0.0}
    # 32 m at 5 m/s, looking every half second.
    assert found["t"] == 6500
    assert played.space.measure("found", "person") == 1


def test_coverage_covers_all(tmp_path: Path) -> None:
    system = changed(
        system_of(tmp_path, robots=2),
        member={"body": numbers(radius=0.3, speed=10)},
        model=ModelUse("coverage", numbers(width=10)),
    )
    played = Played(system, until=600)
    assert len(played.events("do.Walk.succeeded")) == 2
    assert played.space.measure("covered", "rover") > 0.97


def test_coverage_ends_where_a_target_is_seen(tmp_path: Path) -> None:
    system = changed(
        system_of(tmp_path, robots=1),
        environment={"targets": (Targets("person", 1, (Point(50, 40),)),)},
        member={"body": numbers(radius=0.3, speed=10)},
        camera={"sights": (Sight("person", numbers(range=6, rate=5)),)},
        model=ModelUse("coverage", numbers(width=8)),
    )
    played = Played(system, until=600)
    (found,) = played.events("do.Walk.succeeded")
    assert found["data"]["target_id"] == "person[0]"
    assert math.dist(found["at"][:2], (50, 40)) < 8


def test_a_lost_robot_stays_and_goes_on_later(tmp_path: Path) -> None:
    system = at(system_of(tmp_path, robots=1), 10, 20)
    fault = Fault(Fixed(2 * SECOND), ("rover[0]",), lasts=5 * SECOND)
    played = Played(system, scenario=replace(go_to(70, 20), faults=(fault,)))
    (arrived,) = played.events("do.Walk.succeeded")
    assert arrived["t"] == pytest.approx((12 + 5) * 1000, abs=200)


def test_wind_carries_off_who_flies_slower(tmp_path: Path) -> None:
    system = changed(
        system_of(tmp_path, robots=1),
        environment={"winds": (Wind(3.0, 0.0),)},
        role={"start": Point(10, 20)},
        member={"body": numbers(radius=0.3, speed=2, climb=5)},
    )
    played = Played(system, scenario=go_to(10, 20, height=10.0), until=12)
    x, _, z = played.space.at(played.robot()) or (0, 0, 0)
    assert z == pytest.approx(10, abs=0.1)
    assert 16 < x < 24  # about 12 s at 1 m/s


def test_a_world_without_places_has_none(tmp_path: Path) -> None:
    system = full(tmp_path)
    played = Played(system, kind="abstract", until=10)
    assert not any("at" in line for line in played.lines)
    assert played.events("do.Walk.succeeded")
    plain = Played(system_of(tmp_path, robots=4), until=10)
    assert plain.lines == played.lines
