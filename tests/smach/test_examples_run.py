"""The machines of the examples, run through their missions."""

from collections.abc import Callable
from typing import Any

from swarmdsl.ir import Named


def test_uav_mission(example: Callable[..., Any]) -> None:
    uav = example("search_and_rescue", "uav_search")
    world = uav.world
    uav.start()
    uav.wait_in("Mission/Idle")
    world.publish("bridge/events/mission_start")
    assert world.wait_for("cmd/takeoff").content.altitude == 2.5
    world.finish("cmd/takeoff")
    pose = world.default(Named("geometry_msgs", "PoseStamped"))
    world.finish("uav_coverage", target_id="t1", target_pose=pose)
    auction = world.wait_for("cmd/task_allocation_auction").content
    assert (auction.task_id, auction.task_pose) == ("t1", pose)
    world.finish("cmd/task_allocation_auction", "aborted")
    world.finish("cmd/task_allocation_auction", winner="r1")
    assert world.wait_for("uav_tracking").content.target == "t1"
    world.finish("uav_tracking", "aborted")
    world.finish("uav_local_coverage", "aborted", target_id="nothing")
    world.finish("uav_coverage", target_id="t2")
    assert world.wait_for("cmd/task_allocation_auction").content.task_id == "t2"
    assert uav.preempt() == "preempted"
    assert ("cancel", "cmd/task_allocation_auction") in world.log
