"""The nodes of the examples, in the graph that they are made for."""

import signal
from collections.abc import Callable
from typing import Any

import pytest

World = Callable[..., Any]


def test_uav_mission(world: World) -> None:
    uav = world(example="search_and_rescue")
    uav.serve()
    node = uav.node("uav_search")
    node.wait_in("Mission/Idle")
    uav.publish("MissionStart")
    assert uav.wait_for("uav_mavros_takeoff") == {"altitude": 2.5}
    uav.end("uav_mavros_takeoff")
    uav.end("uav_coverage", target_id="t1", target_pose={"pose": {"position": {"x": 4.0}}})
    auction = uav.wait_for("auction_action")
    assert auction["task_id"] == "t1"
    assert auction["task_pose"]["pose"]["position"]["x"] == 4.0
    uav.end("auction_action", "aborted")
    uav.end("auction_action", winner="r1")
    assert uav.wait_for("uav_tracking") == {"target": "t1", "altitude": 2.5}
    uav.end("uav_tracking", "aborted")
    uav.wait_for("uav_local_coverage")
    uav.publish("MissionAbort")
    uav.cancelled("uav_local_coverage")
    uav.end("uav_mavros_land", "aborted")
    uav.end("uav_mavros_land")
    node.wait_in("Mission/Idle")
    assert node.signal(signal.SIGTERM) == 0


# How many steps of the mission lead to each state of the UAV.
MISSION = ["uav_mavros_takeoff", "uav_coverage", "auction_action", "uav_tracking", "aborted"]
STATES = ["Idle", "TakeOff", "Coverage", "SelectRover", "Tracking", "LocalCoverage"]


@pytest.mark.parametrize(
    "state",
    # The same transition leaves all of them.
    [
        pytest.param(each, marks=[pytest.mark.thorough] if each in STATES[1:-1] else [])
        for each in STATES
    ],
)
def test_mission_abort_lands_the_uav_from_every_state(state: str, world: World) -> None:
    uav = world(example="search_and_rescue")
    uav.serve()
    node = uav.node("uav_search")
    node.wait_in("Mission/Idle")
    number = STATES.index(state)
    if number:
        uav.publish("MissionStart")
    for step in MISSION[: max(number - 1, 0)]:
        if step == "uav_tracking":
            uav.end(step, "aborted")
        else:
            uav.end(step)
    node.wait_in(f"Mission/{state}")
    running = [*MISSION[:4], "uav_local_coverage"][number - 1] if number else None
    if running is not None:
        uav.wait_for(running)
    uav.publish("MissionAbort")
    uav.end("uav_mavros_land")
    if running is not None:
        uav.cancelled(running)
    node.wait_in("Mission/Idle")


def test_rover_mission(world: World) -> None:
    rover = world(example="search_and_rescue")
    rover.serve()
    node = rover.node("rover_rescue")
    node.wait_in("Idle")
    rover.publish("MissionStart")
    node.wait_in("Mission/Rescue/Ready", "Mission/Watch/Watching")
    rover.publish("TargetFound", id="t1", pose={"pose": {"position": {"y": 3.0}}})
    assert rover.wait_for("bid_action")["task_id"] == "t1"
    rover.end("bid_action", task_pose={"pose": {"position": {"y": 4.0}}})
    assert rover.wait_for("ugv_move_to")["goal"]["pose"]["position"]["y"] == 4.0
    rover.publish("MissionAbort")
    rover.cancelled("ugv_move_to")
    assert node.ended() == 0


def test_blinker(world: World) -> None:
    blinker = world(example="minimal")
    blinker.serve(blink=["succeeded", "succeeded", "aborted"])
    assert blinker.node("blinking").ended() == 0
    assert blinker.called() == ["cmd/blink"] * 3


def test_evacuation(world: World) -> None:
    robot = world(example="emergency_exit")
    robot.serve()
    node = robot.node("evacuation")
    robot.end("wander", "aborted")
    robot.wait_for("wander")
    robot.publish("Alarm")
    robot.cancelled("wander")
    robot.end("wander", found=True, width=0.9)
    assert robot.sent("SawExit")["width"] == pytest.approx(0.9)
    robot.end("leave")
    assert node.ended() == 0


def test_worker_carries_a_box(world: World) -> None:
    worker = world(example="storage")
    worker.serve()
    node = worker.node("worker_behavior")
    node.wait_in("Idle")
    worker.publish("ShiftStart")
    node.wait_in("Shift/Work/Ready", "Shift/Charge/Enough")
    worker.publish("BoxFound", id="b1", swarmio={"node": "scout_1"})
    bid = worker.wait_for("bid_for_task")
    assert (bid["auctioneer"], bid["task_id"]) == ("scout_1", "b1")
    worker.end("bid_for_task")
    worker.end("move_to", "aborted")
    worker.end("move_to")
    assert worker.wait_for("elevator_lift")["up"] is True
    worker.end("elevator_lift", lifted=True)
    worker.end("move_to")
    worker.end("elevator_lift")
    assert worker.sent("BoxStored")["id"] == "b1"
    worker.publish("Battery", soc=12)
    assert node.ended() == 0


def test_scout_goes_home_at_the_end_of_the_shift(world: World) -> None:
    scout = world(example="storage")
    scout.serve()
    node = scout.node("scout_behavior", home=7.5)
    node.wait_in("Idle")
    scout.publish("ShiftStart")
    scout.end("ugv_random_walk", target_id="b1")
    assert scout.sent("BoxFound")["id"] == "b1"
    scout.end("assign_task", winner="")
    scout.sent("BoxFound", 2)
    scout.publish("ShiftEnd")
    scout.cancelled("assign_task")
    assert scout.wait_for("go_home")["goal"]["pose"]["position"]["x"] == 7.5
    scout.end("go_home", "aborted")
    scout.end("go_home")
    assert node.ended() == 0


def test_flock_goes_on_as_it_was_before_a_danger(world: World) -> None:
    bird = world(example="flocking")
    bird.serve()
    node = bird.node("flock")
    node.wait_inside("Ground")
    bird.publish("Start")
    bird.wait_for("uav_flocking")
    bird.publish("Scatter")
    bird.cancelled("uav_flocking")
    bird.wait_for("uav_random_walk")
    bird.publish("Danger", vector={"magnitude": 0.1})
    bird.cancelled("uav_random_walk")
    assert bird.wait_for("hold") == {"data": True}
    bird.end("hold")
    node.wait_in("Hover")
    bird.publish("Danger", vector={"magnitude": 100.0})
    assert bird.wait_for("hold") == {"data": False}
    bird.end("hold")
    bird.wait_for("uav_random_walk")
    bird.publish("Stop")
    bird.cancelled("uav_random_walk")
    assert node.ended() == 0


NODES = [
    ("minimal", "blinking"),
    ("search_and_rescue", "uav_search"),
    ("search_and_rescue", "rover_rescue"),
    ("emergency_exit", "evacuation"),
    ("flocking", "flock"),
    ("storage", "scout_behavior"),
    ("storage", "worker_behavior"),
    ("cpswarm", "uav_sar"),
    ("cpswarm", "scout_mission"),
    ("cpswarm", "worker_mission"),
    ("cpswarm", "turtlebot_rescue"),
    ("cpswarm", "carts"),
]


@pytest.mark.parametrize(("example", "module"), NODES)
def test_every_node_ends_when_it_is_told(example: str, module: str, world: World) -> None:
    surroundings = world(example=example)
    known = {path.name for path in (surroundings.package / "scripts").iterdir()}
    assert known == {each for folder, each in NODES if folder == example}
    node = surroundings.node(module)
    node.wait_inside("")
    assert node.signal(signal.SIGTERM) == 0
