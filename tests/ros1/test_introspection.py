"""Node with `~introspection` as seen by smach_viewer; needs real smach_ros."""

from collections.abc import Callable
from typing import Any

import pytest

World = Callable[..., Any]
TOPIC = "smach_server/smach/container_status"


def test_status_of_the_containers(world: World, smach_path: tuple[Any, ...]) -> None:
    if any(folder.name == "stand_in" for folder in smach_path):
        pytest.skip("no real smach_ros: SWARMDSL_SMACH_PATH names the folders of it")
    uav = world(example="search_and_rescue")
    uav.serve()
    uav.peers.order("listen", TOPIC, type="smach_msgs/SmachContainerStatus")
    node = uav.node("uav_search", introspection=True)
    node.wait_inside("Mission")
    uav.publish("MissionStart")
    uav.wait_for("uav_mavros_takeoff")

    def active() -> dict[str, list[str]]:
        told = [content for name, content in uav.peers.all("sent") if name == TOPIC]
        return {status["path"]: status["active_states"] for status in told}

    uav.graph.wait_until(
        lambda: active().get("/uav_search/Mission") == ["TakeOff"], "the state is shown"
    )
