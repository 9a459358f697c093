"""The world of `--ros2` beside nodes that are simulated here; `tests/ros2` has real ones."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.cli import run
from swarmdsl.execution.ros2_world import command
from swarmdsl.execution.ros2_world.holds import PATIENCE, Holds
from swarmdsl.execution.ros2_world.messages import fill, plain
from swarmdsl.execution.ros2_world.names import name_in, namespace
from swarmdsl.execution.ros2_world.served import ServedWorld
from swarmdsl.execution.simulate.inputs.choose_space import choose_space
from swarmdsl.execution.simulate.machines.actors import actors
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import SECOND, Fixed
from swarmdsl.execution.simulate.scenario.scenario import Robot, Scenario
from swarmdsl.ir import Communication, Delivery, ModelUse, Named, Point, RobotValues

from .worlds import TEXT, changed, numbers, system_of


class Sender:
    def __init__(self) -> None:
        self.sent: list[Any] = []
        self.listeners = 2

    def wire(self, data: Any) -> bytes:
        return b"head" + repr(data).encode()

    def read(self, wire: bytes) -> Any:
        raise AssertionError(wire)

    def send(self, wire: bytes) -> None:
        self.sent.append(wire)


class Graph:
    """Graph of ROS that notes what a world serves, publishes and hears."""

    clocks = 2

    def __init__(self) -> None:
        self.servers: dict[str, tuple[Any, Any]] = {}
        self.senders: dict[str, Sender] = {}
        self.heard: dict[str, Callable[[Any], None]] = {}

    def serve(self, name: str, call: Communication, begin: Any, cancel: Any) -> None:
        self.servers[name] = (begin, cancel)

    def sender(self, topic: str, type_: Named, delivery: Delivery) -> Sender:
        return self.senders.setdefault(topic, Sender())

    def hear(self, topic: str, type_: Named, hear: Callable[[Any], None]) -> None:
        self.heard[topic] = hear

    def hear_wire(
        self, topic: str, type_: Named, delivery: Delivery, hear: Callable[[bytes], None]
    ) -> None:
        self.heard[topic] = hear

    def tell_time(self, time: int) -> None:
        raise AssertionError

    def spin(self, seconds: float) -> None:
        raise AssertionError


class Goal:
    def __init__(self, **data: Any) -> None:
        self.data = data
        self.ends: list[tuple[str, dict[str, Any]]] = []

    def end(self, outcome: str, fields: dict[str, Any]) -> None:
        self.ends.append((outcome, fields))


WALKS = {
    "model": ModelUse("go_to", ()),
    "role": {
        "robots": (RobotValues(0, (), start=Point(10, 20)), RobotValues(1, (), start=Point(60, 20)))
    },
}


@pytest.fixture
def world(tmp_path: Path) -> Callable[..., tuple[ServedWorld, Graph]]:
    def world(ends: Any = None, text: str = TEXT, **member: Any) -> tuple[ServedWorld, Graph]:
        to = {"model": "go_to", "arguments": {"to": (40.0, 20.0, 0.0)}}
        scenario = Scenario(functions={("walk", ""): to, ("walk", "rover[1]"): ends or to})
        body = numbers(radius=0.3, speed=5)
        blocks = {"body": body, **member}
        system = changed(system_of(tmp_path, text), member=blocks, role=WALKS["role"])
        (swarm,) = system.swarms
        subject, report = Subject(swarm.name, system, swarm), Diagnostics()
        spaces = choose_space("flat", subject, scenario, report)
        cast = actors(subject, subject.create_robots({}), scenario, report)
        assert not report.has_errors
        assert spaces.setting is not None
        graph = Graph()
        space = spaces.alone(0)
        made = ServedWorld(subject, scenario, cast, spaces.setting, space, 0, graph)
        made.begin()
        return made, graph

    return world


def test_a_goal_moves_the_robot_and_ends_with_its_result(world: Any) -> None:
    made, graph = world()
    begin, _ = graph.servers["/s/rover_0/walk"]
    goal = Goal(altitude=0.0)
    begin(goal)
    made.clock.advance(5 * SECOND)
    assert goal.ends == []
    made.clock.advance(2 * SECOND)
    ((outcome, fields),) = goal.ends
    assert outcome == "succeeded"
    assert fields["target_pose"]["pose"]["position"]["x"] == pytest.approx(40, abs=0.2)
    assert made.holds.is_waiting  # for what the node makes of it


@pytest.mark.parametrize(
    ("ends", "expected"),
    [
        ({"duration": Fixed(3 * SECOND), "results": ({"target_id": "a"},)}, "succeeded"),
        ({"duration": Fixed(3 * SECOND), "aborted": 1.0}, "aborted"),
        ({"never": 1.0}, None),
    ],
)
def test_a_function_without_a_model_ends_as_the_scenario_says(
    ends: Any, expected: str | None, world: Any
) -> None:
    made, graph = world(ends)
    begin, cancel = graph.servers["/s/rover_1/walk"]
    goal, other = Goal(altitude=0.0), Goal(altitude=0.0)
    begin(goal)
    made.clock.advance(3 * SECOND - 1)
    assert goal.ends == []
    made.clock.advance(1)
    fields = dict(ends.get("results", ({},))[0])
    assert goal.ends == ([(expected, fields)] if expected else [])
    begin(other)
    cancel(other)
    made.clock.advance(9 * SECOND)
    assert other.ends == [("preempted", {})]


def test_a_cancelled_goal_stops_the_robot(world: Any) -> None:
    made, graph = world()
    begin, cancel = graph.servers["/s/rover_0/walk"]
    goal = Goal(altitude=0.0)
    begin(goal)
    made.clock.advance(2 * SECOND)
    cancel(goal)
    place = made.space.at(made.robots[0])
    made.clock.advance(5 * SECOND)
    assert goal.ends == [("preempted", {})]
    assert made.space.at(made.robots[0]) == place == pytest.approx((20, 20, 0), abs=0.6)


def test_an_empty_battery_aborts_the_goal(world: Any) -> None:
    made, graph = world(battery=numbers(capacity=100, moving=100))
    goal = Goal(altitude=0.0)
    graph.servers["/s/rover_0/walk"][0](goal)
    made.clock.advance(3 * SECOND)
    assert goal.ends == [("aborted", {})]
    assert made.space.at(made.robots[0]) == pytest.approx((15, 20, 0), abs=0.6)
    late = Goal(altitude=0.0)
    graph.servers["/s/rover_0/walk"][0](late)
    assert late.ends == [("aborted", {})]


@pytest.mark.parametrize(("reach", "arrives"), [(60, True), (40, False)])
def test_radio_relays_events_within_its_range(world: Any, reach: float, arrives: bool) -> None:
    made, graph = world(radio=numbers(range=reach))
    graph.heard["/s/rover_0/radio/hello"](b"head, and a text")
    made.clock.advance(SECOND)
    sent = graph.senders["/s/rover_1/radio/hello"].sent
    assert sent == ([b"head, and a text"] if arrives else [])
    assert graph.senders["/s/rover_0/radio/hello"].sent == []
    # What the world has published itself comes back, and goes nowhere.
    for wire in sent:
        graph.heard["/s/rover_1/radio/hello"](wire)
    made.clock.advance(SECOND)
    assert graph.senders["/s/rover_0/radio/hello"].sent == []


def test_robots_hear_a_person_wherever_they_are(world: Any) -> None:
    text = TEXT.replace("swarm event Hello", "swarm operator event Hello")
    made, graph = world(text=text, radio=numbers(range=1))
    graph.heard["/s/hello"](b"head")
    sent = [graph.senders[f"/s/rover_{n}/radio/hello"].sent for n in (0, 1)]
    assert sent == [[b"head"], [b"head"]]
    made.lose(made.robots[0])
    # What comes back from the topic of a robot goes nowhere.
    graph.heard["/s/rover_1/radio/hello"](b"head")
    graph.heard["/s/hello"](b"head")
    assert sent == [[b"head"], [b"head", b"head"]]
    # Robots alone send other events.
    assert "/s/target_found" not in graph.heard


def test_holds_wait_for_what_is_missing_but_not_for_ever() -> None:
    now = 0.0
    holds = Holds(lambda: now)
    assert not holds.is_waiting
    holds.expect("line", "uav[0]", "do.")
    holds.came("line", "uav[1]", "do.")
    assert holds.is_waiting
    holds.came("line", "uav[0]", "do.")
    assert not holds.is_waiting
    holds.came("call", "uav[0]", "go", early=True)
    holds.expect("call", "uav[0]", "go")
    assert not holds.is_waiting
    holds.expect("call", "uav[0]", "go")
    now = PATIENCE
    assert not holds.is_waiting
    assert holds.given_up == 1


def test_names_are_those_of_launch_files() -> None:
    assert namespace("SearchAndRescue", Robot("uav[1]", "uav", index=1)) == (
        "/search_and_rescue/uav_1"
    )
    assert name_in("/s/uav_1", "cmd/go") == "/s/uav_1/cmd/go"
    assert name_in("/s/uav_1", "/go") == "/go"


class Stamp:
    def __init__(self) -> None:
        self.sec = self.nanosec = 0

    def get_fields_and_field_types(self) -> dict[str, str]:
        return {"sec": "int32", "nanosec": "uint32"}


class Message:
    def __init__(self) -> None:
        self.stamp, self.length, self.raw, self.many = Stamp(), 0.0, b"\0", [0.0]

    def get_fields_and_field_types(self) -> dict[str, str]:
        stamp = "builtin_interfaces/Time"
        return {"stamp": stamp, "length": "double", "raw": "octet", "many": "sequence<double>"}


def test_messages_are_filled_and_read_with_the_types_of_their_fields() -> None:
    values = {"stamp": 3 * SECOND + 5, "length": 2, "raw": 7, "many": [1, 2], "unknown": 1}
    message = fill(Message(), values, lambda type_: None)
    assert (message.stamp.sec, message.stamp.nanosec) == (3, 5)
    assert isinstance(message.length, float)
    assert all(isinstance(each, float) for each in message.many)
    assert plain(message) == {name: values[name] for name in ("stamp", "length", "raw", "many")}


# ---- mistakes

BEATING = "  environment Field\n  heartbeat 1 s lost after 5 s\n}"
FOLLOWED = (
    TEXT.replace("ROBOTS", "2")
    .replace("  environment Field\n}", BEATING)
    .replace("state Stuck { }", "state Stuck { on member_lost -> Told }")
)


@pytest.fixture
def said(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> Callable[..., tuple[int, str]]:
    monkeypatch.chdir(tmp_path)

    def said(*more: str, scenario: str = "", there: bool = True) -> tuple[int, str]:
        monkeypatch.setattr(command, "is_there", lambda: there)
        Path("demo.swarm").write_text(FOLLOWED, encoding="utf-8")
        Path("s.toml").write_text(scenario, encoding="utf-8")
        words = ["simulate", "demo.swarm", "--ros2", "--scenario", "s.toml", *more]
        return run(words), capsys.readouterr().err

    return said


def test_a_missing_rclpy_is_reported(said: Any) -> None:
    code, err = said(there=False)
    assert code == 1
    assert "error[SW1021]: cannot serve the robots to nodes of ROS 2: there is no rclpy" in err
    assert "setup.sh" in err


@pytest.mark.parametrize(
    ("scenario", "reason"),
    [
        ('[world]\nkind = "abstract"', "its robots are nowhere"),
        ('[[faults]]\nat = "1 s"\nsilent = "walk"', "`silent` of `walk`"),
        ('[[faults]]\nat = "1 s"\nlost = "rover[0]"\nlasts = "1 s"', "cannot come back"),
        ('[[messages]]\nat = "1 s"\nevent = "member_lost"', "is on no topic"),
    ],
)
def test_what_cannot_be_served_is_reported(said: Any, scenario: str, reason: str) -> None:
    code, err = said(*([] if "world" in scenario else ["--world", "flat"]), scenario=scenario)
    assert code == 1
    assert "SW1021" in err
    assert reason in err


@pytest.mark.parametrize(
    ("more", "reason"),
    [
        (("--real-time",), "`--ros2` and `--real-time` conflict"),
        (("--replay", "x.jsonl"), "`--ros2` and `--replay` conflict"),
        (("--trace", "json"), "`--ros2` and `--trace` conflict"),
        (("--runs", "2"), "`--ros2` and `--runs` conflict"),
        (("--world", "abstract"), "`--ros2` and `--world abstract` conflict"),
        (("--real-time-factor", "0"), "0.0 is not in the range"),
    ],
)
def test_options_that_conflict_are_reported(said: Any, more: tuple[str, ...], reason: str) -> None:
    code, err = said(*more)
    assert code == 2
    assert reason in err


def test_a_factor_needs_nodes(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["simulate", "x.swarm", "--real-time-factor", "2"]) == 2
    assert (
        "`--real-time-factor` needs `--real-time`, `--live` or `--ros2`" in capsys.readouterr().err
    )
