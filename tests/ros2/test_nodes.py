"""Generated nodes on a real ROS 2, with servers that do what servers do."""

from __future__ import annotations

import itertools
import json
import operator
import time
from itertools import pairwise
from typing import Any

import pytest

TAKE_OFF = ("/sar/uav_0/cmd/takeoff", "uav_mavros_takeoff/action/TakeOff")
COVERAGE = ("/sar/uav_0/uav_coverage", "cpswarm_msgs/action/Coverage")
AUCTION = ("/sar/uav_0/cmd/task_allocation_auction", "cpswarm_msgs/action/TaskAllocation")
LAND = ("/sar/uav_0/cmd/land", "std_srvs/srv/Empty")
WORK = ("/lab/work", "lab_msgs/action/Work")
OTHER = ("/lab/other_work", "lab_msgs/action/Work")
RING = ("/lab/ring", "std_srvs/srv/Trigger")
ASK = ("/lab/ask", "lab_msgs/srv/Ask")
TAKEN_OFF = "do.Mission.TakeOff.succeeded"


class Uav:
    """A UAV of the example, and an operator who starts and aborts missions."""

    def __init__(self, ros: Any) -> None:
        self.fakes = ros.fakes()
        for event in ("start", "abort"):
            self.fakes.publisher(f"/sar/mission_{event}", "swarmros/msg/SimpleEvent")
        self.ros = ros

    def start(self, **parameters: Any) -> Any:
        given = {"member": "uav[0]", "timeouts__server": 1.0, **parameters}
        self.node = self.ros.node("sar_behavior.uav_search", "/sar/uav_0", **given)
        for event in ("start", "abort"):
            self.fakes.listeners(f"/sar/mission_{event}")
        self.node.wait_in("Mission.Idle")
        return self.node

    def say(self, event: str) -> None:
        self.fakes.publish(f"/sar/mission_{event}")


@pytest.fixture
def uav(ros: Any) -> Uav:
    return Uav(ros)


def test_a_goal_that_succeeds(uav: Uav) -> None:
    uav.fakes.action(*TAKE_OFF, "succeeded")
    uav.fakes.action(*COVERAGE, {"outcome": "succeeded", "result": {"target_id": "walker"}})
    uav.fakes.action(*AUCTION, "never")
    node = uav.start(altitude=4.5)
    uav.say("start")

    assert uav.fakes.wait("goal", TAKE_OFF[0])["data"] == {"altitude": 4.5}
    assert uav.fakes.wait("goal", AUCTION[0])["data"]["task_id"] == "walker"
    node.wait_in("Mission.SelectRover")


def test_a_goal_that_always_fails_is_tried_again_after_pauses(uav: Uav) -> None:
    uav.fakes.action(*TAKE_OFF, "succeeded")
    uav.fakes.action(*COVERAGE, "succeeded")
    uav.fakes.action(*AUCTION, *["reject"] * 4, "succeeded")
    uav.fakes.action("/sar/uav_0/uav_tracking", "cpswarm_msgs/action/Tracking", "never")
    node = uav.start()
    uav.say("start")

    node.wait_in("Mission.Tracking")
    ends = [line["t"] for line in node.trace if "SelectRover" in str(line["event"])]
    pauses = [later - earlier for earlier, later in pairwise(ends)]
    wanted = (100, 200, 400, 800)
    assert all(map(operator.ge, pauses, wanted)), pauses
    assert len(pauses) == len(wanted)


@pytest.mark.parametrize("outcome", ["reject", "aborted"])
def test_a_goal_that_fails(uav: Uav, outcome: str) -> None:
    uav.fakes.action(*TAKE_OFF, outcome)
    uav.fakes.service(*LAND)
    node = uav.start()
    uav.say("start")

    assert node.wait_for("do.Mission.TakeOff.aborted")["started"] == ["uav_mavros_land"]
    uav.fakes.wait("request", LAND[0])
    node.wait_in("Mission.Idle")


def test_a_goal_is_cancelled_when_its_state_is_left(uav: Uav) -> None:
    uav.fakes.action(*TAKE_OFF, "succeeded")
    uav.fakes.action(*COVERAGE, "never", stopping=0.3)
    uav.fakes.service(*LAND, {"outcome": "succeeded", "after": 0.1})
    node = uav.start()
    uav.say("start")
    uav.fakes.wait("goal", COVERAGE[0])
    uav.say("abort")

    line = node.wait_for("MissionAbort")
    assert (line["cancelled"], line["started"]) == (["uav_coverage"], ["uav_mavros_land"])
    uav.fakes.wait("stopped", COVERAGE[0])
    node.wait_in("Mission.Idle")


def test_the_next_goal_waits_until_the_server_has_stopped(uav: Uav) -> None:
    uav.fakes.action(*TAKE_OFF, "succeeded")
    uav.fakes.action(*COVERAGE, "never", stopping=0.5)
    uav.fakes.service(*LAND)
    node = uav.start()
    uav.say("start")
    uav.fakes.wait("goal", COVERAGE[0])
    uav.say("abort")
    node.wait_for("do.Abort.Land.succeeded")
    uav.say("start")
    uav.fakes.wait("goal", COVERAGE[0], 2)

    seen = [next(iter(each)) for each in uav.fakes.seen if COVERAGE[0] in each.values()]
    assert [each for each in seen if each != "begun"] == ["goal", "cancel", "stopped", "goal"]


def test_a_server_that_does_not_stop_is_given_up(uav: Uav) -> None:
    uav.fakes.action(*TAKE_OFF, "succeeded")
    uav.fakes.action(*COVERAGE, "never", stopping=None)
    uav.fakes.service(*LAND)
    node = uav.start(timeouts__cancel=0.3)
    uav.say("start")
    uav.fakes.wait("goal", COVERAGE[0])
    uav.say("abort")
    node.wait_for("do.Abort.Land.succeeded")
    uav.say("start")

    uav.fakes.wait("goal", COVERAGE[0], 2)
    assert "uav_coverage on uav_coverage does not stop" in node.log


def test_a_server_that_is_not_there(uav: Uav) -> None:
    uav.fakes.service(*LAND)
    node = uav.start(timeouts__server=0.5)
    before = time.monotonic()
    uav.say("start")

    node.wait_for("do.Mission.TakeOff.aborted")
    assert time.monotonic() - before > 0.5
    assert "uav_mavros_takeoff on cmd/takeoff has no server" in node.log


def test_a_server_that_does_not_answer(uav: Uav) -> None:
    """A goal that it accepts after all, when nobody waits for that any more, is cancelled."""
    uav.fakes.action(*TAKE_OFF, {"outcome": "never", "hesitates": 1.5})
    uav.fakes.service(*LAND)
    node = uav.start(timeouts__server=0.5)
    uav.say("start")

    node.wait_for("do.Mission.TakeOff.aborted")
    assert "uav_mavros_takeoff on cmd/takeoff does not answer" in node.log
    uav.fakes.wait("stopped", TAKE_OFF[0])


def test_a_server_that_comes_late(uav: Uav) -> None:
    uav.fakes.action(*COVERAGE, "never")
    node = uav.start(timeouts__server=10.0)
    uav.say("start")
    node.wait_in("Mission.TakeOff")
    uav.fakes.action(*TAKE_OFF, "succeeded")

    node.wait_for(TAKEN_OFF)


def test_a_server_that_goes(uav: Uav) -> None:
    uav.fakes.action(*TAKE_OFF, "never")
    uav.fakes.service(*LAND)
    node = uav.start(timeouts__server=0.3)
    uav.say("start")
    # A server that is destroyed before it works on the goal would stay for it.
    uav.fakes.wait("begun", TAKE_OFF[0])
    uav.fakes.do("gone", name=TAKE_OFF[0])

    node.wait_for("do.Mission.TakeOff.aborted")
    assert "uav_mavros_takeoff on cmd/takeoff has lost its server" in node.log


def test_a_server_that_is_killed(uav: Uav) -> None:
    server = uav.ros.fakes()
    server.action(*TAKE_OFF, "never")
    uav.fakes.service(*LAND)
    node = uav.start(timeouts__server=0.3)
    uav.say("start")
    server.wait("begun", TAKE_OFF[0])
    server.process.kill()

    node.wait_for("do.Mission.TakeOff.aborted")
    node.wait_in("Mission.Idle")


@pytest.mark.parametrize("number", [2, 15], ids=["SIGINT", "SIGTERM"])
def test_signals_cancel_goals(uav: Uav, number: int) -> None:
    uav.fakes.action(*TAKE_OFF, "never", stopping=0.2)
    node = uav.start()
    uav.say("start")
    uav.fakes.wait("goal", TAKE_OFF[0])

    assert node.terminate(number) == 0
    uav.fakes.wait("stopped", TAKE_OFF[0])
    assert node.trace[-1]["cancelled"] == ["uav_mavros_takeoff"]
    assert "Traceback" not in node.log


def test_an_event_that_no_state_waits_for_is_lost(uav: Uav) -> None:
    node = uav.start()
    uav.fakes.action(*TAKE_OFF, "never")
    uav.say("start")
    uav.fakes.wait("goal", TAKE_OFF[0])
    uav.say("start")

    assert node.wait_for("MissionStart", 2)["entered"] == []
    assert uav.fakes.count("goal", TAKE_OFF[0]) == 1


def test_the_state_is_told_to_whoever_comes_later(uav: Uav) -> None:
    uav.start()
    uav.fakes.do(
        "subscribe", topic="/sar/uav_0/uav_search/state", kind="std_msgs/msg/String", latched=True
    )

    message = uav.fakes.wait("message", "/sar/uav_0/uav_search/state")
    assert json.loads(message["data"]["data"]) == {
        "machine": "UavSearch",
        "member": "uav[0]",
        "configuration": ["Mission.Idle"],
        "final": None,
    }


def test_events_are_injected_only_where_that_is_allowed(uav: Uav) -> None:
    uav.fakes.action(*TAKE_OFF, "never")
    topic = "/sar/uav_0/uav_search/events"
    uav.fakes.publisher(topic, "std_msgs/msg/String")
    node = uav.start(debug__inject=True)
    uav.fakes.listeners(topic)
    uav.fakes.publish(topic, data='{"event": "MissionStrat"}')
    uav.fakes.publish(topic, data='{"event": "MissionStart"}')

    node.wait_in("Mission.TakeOff")
    assert "no event" in node.log
    assert "MissionStrat" in node.log


@pytest.mark.parametrize(
    ("parameters", "reason"),
    [
        ({"altitude": "high"}, "altitude"),
        ({"trace__file": "/nowhere/trace.jsonl"}, "the trace cannot be written"),
    ],
)
def test_a_node_that_cannot_start_says_why(ros: Any, parameters: Any, reason: str) -> None:
    node = ros.node("sar_behavior.uav_search", "/sar/uav_0", **parameters)

    assert node.exit_code() == 1
    assert reason in node.log
    assert "Traceback" not in node.log


class Lab:
    """The machine of tests/ros2/models."""

    def __init__(self, ros: Any, *work: Any, **parameters: Any) -> None:
        self.fakes = ros.fakes()
        self.fakes.publisher("/go", "lab_msgs/msg/Order")
        self.fakes.publisher("/told", "lab_msgs/msg/Report")
        self.fakes.publisher("/lab/noise", "lab_msgs/msg/Report")
        self.fakes.publisher("/lab/stop", "std_msgs/msg/Empty")
        self.fakes.action(*WORK, *(work or ("never",)))
        self.fakes.action(*OTHER, {"outcome": "never"})
        self.fakes.service(*ASK, {"outcome": "succeeded", "result": {"answer": True}})
        self.node = ros.node("lab_behavior.lab", "/lab", **parameters)
        for topic in ("/go", "/told", "/lab/noise", "/lab/stop"):
            self.fakes.listeners(topic)
        self.node.wait_in("Idle")

    def go(self, speed: float = 1.0) -> None:
        self.fakes.publish("/go", name="box", speed=speed)


def test_goals_and_results_have_the_values_of_the_model(ros: Any) -> None:
    result = {"count": 3, "took": {"sec": 2, "nanosec": 5}}
    lab = Lab(ros, {"outcome": "succeeded", "result": result}, "never", speed=2.5)
    lab.go()

    goal = lab.fakes.wait("goal", WORK[0])["data"]
    assert goal == {"name": "box", "speed": 5.0, "limit": {"sec": 1, "nanosec": 200_000_000}}
    assert lab.fakes.wait("request", ASK[0])["data"] == {"name": "box"}
    line = lab.node.wait_for("do.Busy.Hands.Working.succeeded")
    assert line["data"] == {"count": 3, "took": 2_000_000_005}


def test_a_goal_is_tried_again_as_often_as_a_param_says(ros: Any) -> None:
    lab = Lab(ros, "aborted", tries=1)
    lab.go()

    lab.node.wait_for("do.Busy.Hands.Working.aborted", 2)
    lab.node.wait_in("Rest")
    assert lab.fakes.count("goal", WORK[0]) == 2


def test_delays_follow_params_and_histories_remember(ros: Any) -> None:
    lab = Lab(ros, patience=0.6)
    lab.go()
    asked = lab.node.wait_for("do.Busy.Head.Thinking.Asking.succeeded")
    bored = lab.node.wait_for("after.Busy.Head.Thinking.Waiting.1")

    assert 290 <= bored["t"] - asked["t"] < 500
    lab.node.wait_in("Busy.Hands.Working", "Busy.Head.Thinking.Bored")


def test_a_delay_that_has_no_length_is_told_before_anything_moves(ros: Any) -> None:
    node = ros.node("lab_behavior.lab", "/lab", patience=float("inf"))

    assert node.exit_code() == 1
    assert "`patience` is inf, which is no duration" in node.log
    assert "Traceback" not in node.log


def test_values_that_ros_holds_in_its_own_way(ros: Any) -> None:
    lab = Lab(ros)
    lab.fakes.do("subscribe", topic="/told", kind="lab_msgs/msg/Report")
    lab.fakes.publish("/lab/noise", number=220, waited={"sec": 0, "nanosec": 1})
    lab.fakes.publish("/lab/noise", number=220, waited={"sec": 3, "nanosec": 1})

    report = lab.fakes.wait("message", "/told")["data"]
    assert (report["number"], report["label"]) == (7, "told")
    assert report["waited"] == {"sec": 3, "nanosec": 1}
    assert report["header"]["stamp"]["sec"] > 0
    lab.node.wait_in("Idle")
    assert [line["event"] for line in lab.node.trace].count("Told") == 0


def test_numbers_that_json_does_not_have_are_in_the_trace(ros: Any) -> None:
    """The trace is replayed, as all are: there the guard `event.speed > 0.0` holds, too."""
    lab = Lab(ros)
    nan = float("nan")
    lab.fakes.publish("/lab/noise", number=220, values=[nan, 1.0, float("-inf")])
    assert lab.node.wait_for("Noise")["data"]["values"] == ["NaN", 1.0, "-Infinity"]
    lab.go(speed=nan)
    assert lab.node.wait_for("Go")["data"]["speed"] == "NaN"
    lab.node.wait_in("Idle")
    lab.go(speed=float("inf"))
    assert lab.node.wait_for("Go", 2)["data"]["speed"] == "Infinity"
    lab.fakes.wait("goal", WORK[0])


def test_a_machine_that_ends_ends_its_node(ros: Any) -> None:
    lab = Lab(ros)
    lab.fakes.publish("/lab/stop")

    assert lab.node.exit_code() == 0
    assert lab.node.trace[-1]["configuration"] == ["Ended"]


YES = {"outcome": "succeeded", "result": {"success": True}}
NO = {"outcome": "succeeded", "result": {"success": False, "message": "no"}}


def test_a_service_that_says_that_it_has_failed(ros: Any) -> None:
    ros.fakes().service(*RING, NO)
    node = ros.node("lab_behavior.bell", "/lab")

    assert node.exit_code() == 0, node.log
    assert node.trace[-1]["event"] == "do.First.aborted"
    assert node.trace[-1]["entered"] == ["Silent"]
    assert "ring on ring was refused: no" in node.log
    # Its delay is longer than ROS can count.
    assert "Traceback" not in node.log


def test_a_model_that_looks_itself_whether_a_service_has_succeeded(ros: Any) -> None:
    ros.fakes().service(*RING, YES, YES, YES, NO)
    node = ros.node("lab_behavior.bell", "/lab")

    assert node.exit_code() == 0
    events = [line["event"] for line in node.trace[1:]]
    assert events == [f"do.{state}.succeeded" for state in ("First", "Second") * 2]
    assert node.trace[-1]["entered"] == ["Refused"]


def test_time_may_be_simulated(ros: Any) -> None:
    lab = Lab(ros, patience=7200.0, use_sim_time=True)
    lab.fakes.do("clock", time=10**9)
    lab.go()
    lab.node.wait_for("do.Busy.Head.Thinking.Asking.succeeded")
    lab.fakes.do("clock", time=3000 * 10**9)
    # The time may come after the event.
    for count in itertools.count(1):
        lab.fakes.publish("/lab/noise")
        if lab.node.wait_for("Noise", count)["t"] > 2_000_000:
            break
    assert lab.node.trace[-1]["configuration"][-1] == "Busy.Head.Thinking.Waiting"
    lab.fakes.do("clock", time=3700 * 10**9)

    bored = lab.node.wait_for("after.Busy.Head.Thinking.Waiting.1")
    assert bored["t"] > 3_600_000
