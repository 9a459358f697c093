"""Offboard control of PX4 in virtual time, with a stand-in for the autopilot and without ROS."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from swarmdsl.codegen.bundled.ros2.runtime.offboard_flight import Flight
from swarmdsl.codegen.bundled.ros2.runtime.offboard_frames import heading, to_ned, turned
from swarmdsl.codegen.bundled.ros2.runtime.offboard_vehicle import Settings

from .autopilot import ARM, DO_LAND, LAND, OFFBOARD, POSITION, SET_MODE, Autopilot
from .conftest import load_module, write_package

_STEP = 0.05


class Air:
    """A flight and its autopilot, which hear each other at each step."""

    def __init__(self) -> None:
        self.ends: list[tuple[str, int, str]] = []
        self.pilot = Autopilot(self._answer)
        settings = Settings(travel=20.0, landing=20.0)
        self.flight = Flight(settings, self._send, self._end)
        self.is_silent = False
        self.is_stuck = False
        self.setpoint: Any = None

    def _send(self, command: int, **values: float) -> None:
        given = {"param1": 0.0, "param2": 0.0, **values}
        self.pilot.hear_command(SimpleNamespace(command=command, target_system=1, **given))

    def _answer(self, command: int, result: int) -> None:
        self.flight.vehicle.hear_answer(SimpleNamespace(command=command, result=result))

    def _end(self, end: Any) -> None:
        self.ends.append(tuple(end))

    def step(self) -> None:
        pilot = self.pilot
        pilot.step(_STEP)
        if not self.is_silent:
            vehicle = self.flight.vehicle
            vehicle.hear_status(pilot.now, SimpleNamespace(**pilot.status()))
            vehicle.hear_landed(SimpleNamespace(landed=pilot.landed))
            place = SimpleNamespace(vy=0.0, vz=0.0, **pilot.position())
            self.flight.hear_position(pilot.now, place)
        if not self.is_stuck:
            self.setpoint = self.flight.step(pilot.now)
            if self.setpoint is not None:
                pilot.hear_setpoint(self.setpoint.position, self.setpoint.yaw)

    def until(self, condition: Callable[[], bool]) -> None:
        end = self.pilot.now + 60
        while not condition():
            assert self.pilot.now < end, (self.pilot, self.ends)
            self.step()

    def fly(self, goal: str, **arguments: Any) -> tuple[str, int, str]:
        """Fly to the end of a goal."""
        count = len(self.ends)
        self.flight.begin(goal, **arguments)
        self.until(lambda: len(self.ends) > count)
        return self.ends[-1]

    def for_time(self, seconds: float) -> None:
        end = self.pilot.now + seconds
        self.until(lambda: self.pilot.now >= end)


_DONE = ("succeeded", 0, "")


@pytest.fixture
def air() -> Air:
    return Air()


@pytest.fixture
def up() -> Air:
    """A vehicle that has taken off to 3 m."""
    made = Air()
    assert made.fly("take_off", altitude=3.0) == _DONE
    return made


def test_a_flight(air: Air) -> None:
    assert air.fly("take_off", altitude=3.0) == _DONE
    assert air.pilot.commands == [SET_MODE, ARM]
    assert air.pilot.place == pytest.approx([0, 0, -3], abs=0.3)
    air.for_time(5)
    assert air.pilot.mode == OFFBOARD  # it holds without a goal

    assert air.fly("go_to", place=(4.0, 2.0, -5.0), yaw=1.0) == _DONE
    assert air.pilot.place == pytest.approx([4, 2, -5], abs=0.3)
    assert air.pilot.yaw == 1.0
    begun = air.pilot.now
    assert air.fly("hold", time=2.0) == _DONE
    assert air.pilot.now - begun >= 2
    # Above the ground where it took off, not above where it is.
    assert air.fly("take_off", altitude=2.0) == _DONE
    assert air.pilot.place == pytest.approx([4, 2, -2], abs=0.3)

    assert air.fly("return_to_launch") == _DONE
    assert air.pilot.place == pytest.approx([0, 0, 0], abs=0.1)
    assert not air.pilot.armed
    assert max(air.pilot.gaps) < 0.5
    air.step()
    assert air.setpoint is None
    assert air.fly("take_off", altitude=1.0) == _DONE
    assert air.fly("land") == _DONE
    assert not air.pilot.armed
    assert air.fly("land") == _DONE  # on the ground it is done


def test_goals_that_cannot_begin(air: Air) -> None:
    for pose in ({"place": (1.0, 0.0, -1.0)}, {"place": (math.nan, 0.0, -1.0)}):
        outcome, code, _ = air.fly("go_to", **pose)
        assert (outcome, code) == ("aborted", 12 if math.isnan(pose["place"][0]) else 11)
    assert air.fly("take_off", altitude=0.0)[:2] == ("aborted", 12)
    assert air.fly("hold", time=math.inf)[:2] == ("aborted", 12)

    air.pilot.system = 2
    assert air.fly("take_off", altitude=3.0) == (
        "aborted",
        3,
        "the vehicle is system 2, not 1",
    )
    air.pilot.system, air.pilot.knows_place = 1, False
    assert air.fly("take_off", altitude=3.0)[:2] == ("aborted", 2)
    air.pilot.knows_place, air.is_silent = True, True
    air.for_time(2)
    assert air.fly("take_off", altitude=3.0)[:2] == ("aborted", 1)
    assert air.pilot.commands == []


def test_commands_that_are_refused_or_not_answered(air: Air) -> None:
    air.pilot.checks = False
    why = "the command to arm is denied: pre-flight checks do not pass"
    assert air.fly("take_off", altitude=3.0) == ("aborted", 4, why)
    assert air.setpoint is None
    air.pilot.checks, air.pilot.mode = True, POSITION
    air.step()
    air.pilot.denies = (SET_MODE,)
    assert air.fly("take_off", altitude=3.0)[:2] == ("aborted", 5)
    air.pilot.denies, air.pilot.is_deaf = (), True
    assert air.fly("take_off", altitude=3.0)[:2] == ("aborted", 7)

    air.pilot.is_deaf = False
    assert air.fly("take_off", altitude=3.0) == _DONE
    air.pilot.denies = (DO_LAND,)
    assert air.fly("land") == ("aborted", 6, "the command land is denied")
    air.for_time(3)
    assert air.pilot.mode == OFFBOARD  # it holds after the refusal
    assert air.pilot.armed


def test_offboard_control_that_is_lost(up: Air) -> None:
    up.flight.begin("go_to", place=(500.0, 0.0, -3.0))
    up.for_time(1)
    up.is_stuck = True  # a node that hangs sends no setpoints
    up.until(lambda: up.pilot.failsafe)
    up.is_stuck = False
    up.until(lambda: len(up.ends) > 1)
    why = "the vehicle has left offboard control in a failsafe: land"
    assert up.ends[-1] == ("aborted", 8, why)
    up.for_time(1)
    assert up.setpoint is None


def test_a_person_takes_over(up: Air) -> None:
    up.for_time(1)
    up.pilot.mode = POSITION
    up.step()
    assert up.setpoint is None  # also without a goal
    assert up.fly("go_to", place=(2.0, 0.0, -3.0)) == _DONE  # a new goal takes control again
    up.flight.begin("land")
    up.until(lambda: up.pilot.mode == LAND)
    up.step()
    up.pilot.mode = POSITION
    up.until(lambda: len(up.ends) > 2)
    assert up.ends[-1][:2] == ("aborted", 8)


def test_cancelled_goals_hold_the_vehicle(up: Air) -> None:
    up.flight.begin("go_to", place=(50.0, 0.0, -20.0))
    up.for_time(1)
    up.flight.cancel()
    up.until(lambda: len(up.ends) > 1)
    assert up.ends[-1] == ("canceled", 0, "")
    here = list(up.pilot.place)
    assert 1 < here[0] < 10
    up.for_time(2)
    assert up.pilot.place == pytest.approx(here, abs=0.5)

    up.flight.begin("land")
    up.until(lambda: up.pilot.mode == LAND)
    up.for_time(0.3)
    up.flight.cancel()
    up.until(lambda: len(up.ends) > 2)
    assert up.ends[-1] == ("canceled", 0, "")
    assert up.pilot.mode == OFFBOARD
    here = list(up.pilot.place)
    up.for_time(2)
    assert up.pilot.place == pytest.approx(here, abs=0.5)
    assert here[2] < -1


@pytest.mark.parametrize("taken", [False, True])
def test_a_goal_that_is_cancelled_before_the_mode_is_taken(up: Air, taken: bool) -> None:
    """Its setpoints go on for the time in which PX4 may take the mode, and end otherwise."""
    up.pilot.mode = POSITION
    up.step()
    assert up.setpoint is None
    up.flight.begin("go_to", place=(50.0, 0.0, -3.0))
    up.for_time(1)
    up.flight.cancel()
    cancelled = up.pilot.now
    up.until(lambda: len(up.ends) > 1)
    assert up.ends[-1] == ("canceled", 0, "")
    here = list(up.pilot.place)
    if taken:
        up.for_time(4)
        up.pilot.mode = OFFBOARD
        up.for_time(10)
        assert up.pilot.mode == OFFBOARD
        assert up.pilot.place == pytest.approx(here, abs=0.1)
        up.pilot.mode = POSITION
    up.until(lambda: up.setpoint is None)
    assert up.pilot.now - cancelled == pytest.approx(14 if taken else 5, abs=0.2)
    assert up.pilot.mode == POSITION
    assert up.fly("go_to", place=(2.0, 0.0, -3.0)) == _DONE


@pytest.mark.parametrize("jumps", [1, 3], ids=["one", "several"])
def test_a_vehicle_stays_where_the_estimate_jumps(up: Air, jumps: int) -> None:
    """PX4 tells the last jump alone; its counters begin again after 255."""
    up.pilot.jumps = 254
    for _ in range(2):
        up.step()
    yaw = up.pilot.yaw
    for _ in range(jumps):
        up.pilot.correct(4.0, -3.0, 1.5, 0.25)
    there = list(up.pilot.place)
    up.for_time(2)
    assert up.pilot.place == pytest.approx(there, abs=0.01)
    assert up.pilot.yaw == pytest.approx(yaw + 0.25 * jumps)
    # The height of a goal is that above the ground, of which the estimate has jumped as well.
    assert up.fly("take_off", altitude=2.0) == _DONE
    assert up.pilot.place == pytest.approx([*there[:2], up.pilot.ground - 2], abs=0.3)


def test_a_goal_stays_where_it_is_in_the_frame(up: Air) -> None:
    """Its heading does not, if the goal has none; what is reached is held."""
    up.flight.begin("go_to", place=(20.0, 0.0, -5.0))
    up.for_time(0.5)
    up.pilot.correct(2.0, 1.0, -0.5, 0.25)
    up.until(lambda: len(up.ends) > 1)
    assert up.ends[-1] == _DONE
    assert up.pilot.place == pytest.approx([20, 0, -5], abs=0.3)
    assert up.pilot.yaw == pytest.approx(0.75)
    up.flight.begin("go_to", place=(10.0, 0.0, -5.0), yaw=1.0)
    up.for_time(0.5)
    up.pilot.correct(0.0, 0.0, 0.0, 0.25)
    up.until(lambda: len(up.ends) > 2)
    assert up.pilot.yaw == pytest.approx(1.0)
    up.pilot.correct(2.0, 1.0, -0.5, 0.25)
    there = list(up.pilot.place)
    up.for_time(2)
    assert up.pilot.place == pytest.approx(there, abs=0.3)
    assert up.pilot.yaw == pytest.approx(1.25)


def test_a_start_that_is_cancelled_stops_the_motors(air: Air) -> None:
    air.flight.begin("take_off", altitude=3.0)
    air.until(lambda: air.pilot.armed)
    air.flight.cancel()
    air.until(lambda: bool(air.ends))
    assert air.ends == [("canceled", 0, "")]
    assert not air.pilot.armed
    assert air.setpoint is None


def test_goals_that_end_by_time_and_by_others(up: Air) -> None:
    assert up.fly("go_to", place=(500.0, 0.0, -3.0))[:2] == ("aborted", 10)
    here = list(up.pilot.place)
    up.for_time(1)
    assert up.pilot.place == pytest.approx(here, abs=0.5)
    up.flight.begin("go_to", place=(0.0, 0.0, -3.0))
    up.step()
    up.flight.begin("hold", time=1.0)
    assert up.ends[-1][:2] == ("aborted", 13)
    up.step()
    up.pilot.armed = False
    up.until(lambda: len(up.ends) > 3)
    assert up.ends[-1][:2] == ("aborted", 9)


def test_frames() -> None:
    assert to_ned(1.0, 2.0, 3.0) == (2.0, 1.0, -3.0)
    assert to_ned(*to_ned(1.0, 2.0, 3.0)) == (1.0, 2.0, 3.0)
    assert turned(0.0) == pytest.approx(math.pi / 2)  # to the east
    assert turned(math.pi / 2) == pytest.approx(0.0)  # to the north
    assert heading(0, 0, math.sin(0.5), math.cos(0.5)) == pytest.approx(1.0)
    assert heading(0, 0, 0, 0) is None


def test_launch_files_start_the_node(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, reported: Any
) -> None:
    package = write_package(Path(__file__).parent / "px4", tmp_path)
    path = package / "launch" / "pair.launch.py"

    def servers(**arguments: str) -> list[tuple[str, str]]:
        started = load_module("launching").launch(
            path, {package.name: package}, monkeypatch.setitem, **arguments
        )
        return [
            (node["namespace"], node["parameters"][0]["member"])
            for node in started
            if node["executable"] == "px4_offboard"
        ]

    robots = [(f"/pair/copter_{n}", f"copter[{n}]") for n in range(2)]
    assert servers() == robots
    assert servers(members="copter_1") == robots[1:]
    assert servers(servers="false") == []
    assert servers(world="true") == []  # the world has these servers

    readme = (package / "README.md").read_text(encoding="utf-8")
    for row in (
        "| `take_off` | `px4_offboard_msgs/TakeOff (action)` | take_off |",
        "| `fmu/in/vehicle_command` | `px4_msgs/VehicleCommand` | sends |",
        "| `timeouts.answer` | `5.0` | Time in which it obeys a command. |",
    ):
        assert row in readme
    for needed in ("geometry_msgs", "px4_msgs", "px4_offboard_msgs"):
        assert f"<depend>{needed}</depend>" in (package / "package.xml").read_text(encoding="utf-8")

    text = (Path(__file__).parent / "px4" / "flight.swarm").read_text(encoding="utf-8")
    found = reported(text.replace("pause", "stay"))
    assert [(name, span) for name, _, span in found] == [("bad-identifier", "stay")]
