"""The nodes of examples/cpswarm do what the machines do that were written by hand for CPSwarm."""

from collections.abc import Callable
from typing import Any

import pytest

pytestmark = pytest.mark.long


World = Callable[..., Any]
EXAMPLE = "cpswarm"


def _pose(x: float = 0.0, y: float = 0.0, frame: str = "") -> dict[str, Any]:
    return {"header": {"frame_id": frame}, "pose": {"position": {"x": x, "y": y}}}


def _place(goal: dict[str, Any]) -> tuple[float, float, float]:
    pose = goal["target_pose"]["pose"]
    return pose["position"]["x"], pose["position"]["y"], pose["orientation"]["w"]


def test_uav(world: World) -> None:
    uav = world(example=EXAMPLE)
    uav.serve()
    node = uav.node("uav_sar", altitude=3.5)
    node.wait_in("Sar/Idle")
    assert uav.wait_for("uav_mavros_takeoff") == {"altitude": 3.5}
    uav.end("uav_mavros_takeoff")
    assert uav.wait_for("uav_coverage") == {"altitude": 3.5}
    uav.end("uav_coverage", target_id="t1", target_pose=_pose(x=2.0))
    uav.end("task_allocation_auction", "aborted")
    auction = uav.wait_for("task_allocation_auction")
    assert auction["task_id"] == "t1"
    assert auction["task_pose"]["pose"]["position"]["x"] == 2.0
    uav.publish("TargetLost")
    uav.cancelled("task_allocation_auction")
    uav.end("uav_local_coverage", target_id="t2")
    uav.end("task_allocation_auction")
    assert uav.wait_for("uav_tracking") == {"target": "t2", "altitude": 3.5}
    uav.publish("MissionAbort")
    uav.cancelled("uav_tracking")
    uav.end("uav_mavros_land")
    node.wait_in("Sar/Idle")


def test_uav_without_its_param_does_not_start(world: World) -> None:
    text = """
    function takeoff : abstraction { action "cmd/takeoff" : cpswarm_msgs/Takeoff }
    action cpswarm_msgs/Takeoff { goal { altitude : float64 } }
    statemachine Uav {
      param altitude : float64
      initial A
      state A { do takeoff(altitude = altitude); on succeeded, aborted -> B }
      final B
    }"""
    uav = world(text)
    uav.serve()
    node = uav.node("uav")
    assert node.ended() == 1
    assert "/uav/altitude" in node.printed()
    node = uav.node("uav", altitude="high")
    assert node.ended() == 1
    assert "/uav/altitude is 'high', which is no float" in node.printed()
    assert "Traceback" not in node.printed()
    assert uav.called() == []


def test_scout(world: World) -> None:
    scout = world(example=EXAMPLE)
    scout.serve()
    node = scout.node("scout_mission")
    scout.end("ugv_coverage", target_id="b1", target_pose=_pose(x=1.0))
    scout.end("task_allocation_auction", "aborted")
    auction = scout.wait_for("task_allocation_auction")
    assert (auction["task_id"], auction["task_pose"]["pose"]["position"]["x"]) == ("b1", 1.0)
    scout.end("task_allocation_auction")
    scout.wait_for("ugv_coverage")
    scout.publish("MissionAbort")
    scout.cancelled("ugv_coverage")
    assert node.ended() == 0


def test_worker(world: World) -> None:
    worker = world(example=EXAMPLE)
    worker.serve()
    node = worker.node("worker_mission", destination_x=5.0)
    node.wait_in("Mission/Idle")
    worker.publish("TargetFound", id="b1", swarmio={"node": "scout"}, pose=_pose(x=1.0))
    bid = worker.wait_for("task_allocation_bid")
    assert (bid["auctioneer"], bid["task_id"]) == ("scout", "b1")
    worker.end("task_allocation_bid", task_pose=_pose(x=2.0))
    assert _place(worker.wait_for("moveto")) == (2.0, 0.0, 0.0)
    worker.end("moveto")
    assert _place(worker.wait_for("moveto")) == (5.0, 0.0, 1.0)
    worker.end("moveto")
    done = worker.wait_for("target_done")
    assert (done["id"], done["pose"]["pose"]["position"]["x"]) == (1, 2.0)
    worker.end("target_done", "aborted")
    assert _place(worker.wait_for("moveto")) == (0.0, -4.0, 1.0)
    worker.publish("GoHome")
    worker.cancelled("moveto")
    assert _place(worker.wait_for("moveto")) == (0.0, -4.0, 1.0)
    worker.end("moveto")
    assert node.ended() == 0


def test_turtlebot(world: World) -> None:
    rover = world(example=EXAMPLE)
    rover.serve()
    node = rover.node("turtlebot_rescue")
    assert rover.wait_for("set_leds") == {"mode": 77, "msgDefault": 5}
    node.wait_in("Sar/Idle/Blue")
    rover.publish("TargetFound", id="t1", swarmio={"node": "uav"}, pose=_pose(y=3.0))
    rover.end("set_leds")
    assert rover.wait_for("set_leds")["msgDefault"] == 4
    rover.end("set_leds")
    cost = rover.wait_for("compute_cost")
    assert (cost["target_id"], cost["sender_UUID"]) == ("t1", "uav")
    rover.end("compute_cost")
    assert rover.wait_for("set_leds")["msgDefault"] == 3
    rover.end("set_leds")
    assert _place(rover.wait_for("move_base"))[1] == 3.0
    rover.end("move_base")
    rover.end("set_leds")
    node.wait_in("Sar/Waiting")
    rover.publish("GoHome")
    home = rover.wait_for("move_base")
    assert home["target_pose"]["header"]["frame_id"] == "map"
    rover.end("move_base")
    assert node.ended() == 0


def test_carts(world: World) -> None:
    summit = world(example=EXAMPLE)
    summit.serve()
    node = summit.node("carts", place_x=6.0)
    node.wait_in("Waiting")
    summit.publish("PickAndPlace", box_id=1, target_pose=_pose(x=1.0, frame="hall"))
    assert summit.sent("CpsState")["state"] == "picking"
    for function in ("global_footprint", "local_footprint", "clear_costmaps"):
        summit.end(function)
    summit.end("move_base", "aborted")
    summit.end("clear_costmaps")
    assert _place(summit.wait_for("move_base"))[0] == 1.0
    summit.end("move_base")
    assert summit.wait_for("ugv_elevator") == {"action": {"action": -1}}
    summit.end("ugv_elevator")
    docking = summit.wait_for("dock")
    assert docking["dock_frame"] == "robot_0_cart"
    assert docking["dock_offset"]["x"] == pytest.approx(-0.1)
    summit.end("dock")
    assert summit.wait_for("drive")["goal"]["theta"] == pytest.approx(3.14)
    summit.end("drive")
    assert summit.wait_for("ugv_elevator") == {"action": {"action": 1}}
    summit.end("ugv_elevator")
    for function in ("global_footprint", "local_footprint", "clear_costmaps"):
        summit.end(function)
    assert summit.sent("CpsState", 2)["state"] == "placing"
    goal = summit.wait_for("move_base")
    assert (_place(goal)[0], goal["target_pose"]["header"]["frame_id"]) == (6.0, "hall")
    for function in ("move_base", "ugv_elevator", "drive", "global_footprint", "local_footprint"):
        summit.end(function)
    assert summit.sent("CpsState", 3)["state"] == "placed"
    node.wait_in("Waiting")
