"""Whole swarms on a real ROS 2: they fly their mission, and one abort lands all."""

from __future__ import annotations

import time
from typing import Any

UAVS = [f"/sar/uav_{number}" for number in range(3)]
ROVERS = [f"/sar/rover_{number}" for number in range(2)]
ACTIONS = "cpswarm_msgs/action"


def test_search_and_rescue(ros: Any) -> None:
    """Three UAVs find a walker, two rovers hear of him and drive; then the mission is aborted."""
    fakes = ros.fakes()
    for event in ("mission_start", "mission_abort"):
        fakes.publisher(f"/sar/{event}", "swarmros/msg/SimpleEvent")
    fakes.publisher("/sar/target_found", "cpswarm_msgs/msg/TargetPositionEvent")
    for uav in UAVS:
        take_off = {"outcome": "succeeded", "after": 0.2}
        found = {"outcome": "succeeded", "after": 0.2, "result": {"target_id": "walker"}}
        fakes.action(f"{uav}/cmd/takeoff", "uav_mavros_takeoff/action/TakeOff", take_off)
        fakes.action(f"{uav}/uav_coverage", f"{ACTIONS}/Coverage", found)
        fakes.action(
            f"{uav}/cmd/task_allocation_auction",
            f"{ACTIONS}/TaskAllocation",
            "aborted",
            {"outcome": "succeeded", "after": 0.1},
        )
        fakes.action(f"{uav}/uav_tracking", f"{ACTIONS}/Tracking", "never", stopping=0.1)
        fakes.service(f"{uav}/cmd/land", "std_srvs/srv/Empty", {"outcome": "ok", "after": 0.2})
    for rover in ROVERS:
        bid = {"outcome": "succeeded", "result": {"task_id": "walker"}}
        fakes.action(f"{rover}/cmd/task_allocation_bid", f"{ACTIONS}/TaskAllocation", bid)
        fakes.action(f"{rover}/cmd/moveto", f"{ACTIONS}/MoveTo", "never")
    uavs = [_start(ros, "uav_search", uav) for uav in UAVS]
    rovers = [_start(ros, "rover_rescue", rover) for rover in ROVERS]
    fakes.listeners("/sar/mission_start", "/sar/mission_abort", count=5)
    fakes.listeners("/sar/target_found", count=2)
    for node in uavs:
        node.wait_in("Mission.Idle")

    fakes.publish("/sar/mission_start")
    for uav, node in zip(UAVS, uavs, strict=True):
        node.wait_in("Mission.Tracking")
        goal = fakes.wait("goal", f"{uav}/uav_tracking")["data"]
        assert goal == {"target": "walker", "altitude": 2.5}
    fakes.publish("/sar/target_found", id="walker", swarmio={"name": "target_found"})
    for rover, node in zip(ROVERS, rovers, strict=True):
        node.wait_in("Mission.Rescue.Drive", "Mission.Watch.Watching")
        fakes.wait("goal", f"{rover}/cmd/moveto")

    fakes.publish("/sar/mission_abort")
    for uav, node in zip(UAVS, uavs, strict=True):
        fakes.wait("stopped", f"{uav}/uav_tracking")
        fakes.wait("request", f"{uav}/cmd/land")
        node.wait_in("Mission.Idle")
    for node in rovers:
        assert node.exit_code() == 0
        assert node.trace[-1]["configuration"] == ["Parked"]
    for node in uavs:
        assert node.terminate() == 0


def test_a_swarm_event_reaches_the_others_and_not_its_sender(ros: Any) -> None:
    """A robot that sees an exit tells the others; it does not hear itself."""
    fakes = ros.fakes()
    fakes.publisher("/hall/alarm", "swarmros/msg/SimpleEvent")
    robots = ["/hall/robot_0", "/hall/robot_1"]
    seen = {"outcome": "succeeded", "after": 0.3, "result": {"found": True, "width": 0.9}}
    fakes.action("/hall/robot_0/wander", "emergency_exit/action/Wander", "never", seen)
    fakes.action("/hall/robot_1/wander", "emergency_exit/action/Wander", "never")
    for robot in robots:
        fakes.action(f"{robot}/leave", "emergency_exit/action/Leave", "never")
    nodes = [
        ros.node("emergency_exit_behavior.evacuation", robot, min_width=0.5) for robot in robots
    ]
    fakes.publisher("/hall/saw_exit", "emergency_exit/msg/ExitSeen")
    fakes.listeners("/hall/alarm", "/hall/saw_exit", count=2)
    time.sleep(1.0)
    fakes.publish("/hall/alarm")

    sent = nodes[0].wait_for("do.Search.succeeded")
    heard = nodes[1].wait_for("SawExit")
    assert sent["sent"] == ["SawExit"]
    assert heard["data"]["width"] == 0.9
    for robot, node in zip(robots, nodes, strict=True):
        node.wait_in("Leaving")
        fakes.wait("goal", f"{robot}/leave")
    # What it hears first is what another one has said later.
    fakes.publish("/hall/saw_exit", width=0.25)
    assert nodes[0].wait_for("SawExit")["data"]["width"] == 0.25


def test_a_swarm_event_of_a_part_is_for_other_robots(ros: Any) -> None:
    """A robot does not hear what another one of its nodes sends."""
    first, second = (
        ros.node("lab_behavior.minding", f"/posts/post_{number}", member=f"post[{number}]")
        for number in range(2)
    )
    for node in (first, second):
        node.wait_in("Listen")
    ros.node("lab_behavior.calling", "/posts/post_0", member="post[0].whistle")
    second.wait_for("Called", 3)

    ros.node("lab_behavior.calling", "/posts/post_1", member="post[1].whistle")
    heard = first.wait_for("Called")
    assert heard["envelope"]["sender"] == "post[1]"


def test_robots_know_who_they_are(ros: Any) -> None:
    """One is a part of a launched robot; the other was started alone, with its name."""
    fakes = ros.fakes()
    fakes.publisher("/lab/go", "lab_msgs/msg/Order")
    fakes.do("subscribe", topic="/lab/named", kind="lab_msgs/msg/Order")
    launched = {"member": "robot[1].eye", "self__count": 5}
    ros.node("lab_behavior.roll", "/lab/robot_1", **launched).wait_in("Silent")
    ros.node("lab_behavior.roll", "/lab/robot_2", member="robot[2]").wait_in("Silent")
    fakes.listeners("/lab/go", count=2)

    for number, (name, speed) in enumerate((("robot[1]", 6.0), ("robot[2]", 5.0)), 1):
        fakes.publish("/lab/go", name=name)
        said = fakes.wait("message", "/lab/named", number)["data"]
        assert said == {"name": "robot", "speed": speed}
    for node in ros.nodes:
        node.wait_in("Heard")


def test_robots_speak_to_one_other(ros: Any) -> None:
    """An event for a robot or a role reaches no other, and can be answered."""
    fakes = ros.fakes()
    fakes.publisher("/lab/go", "lab_msgs/msg/Order")
    for event in ("Asked", "Answer"):
        fakes.publisher(f"/lab/{event.lower()}", f"lab_events/msg/{event}Envelope")
    names = ("robot[0]", "robot[1]", "base[2]")
    first, second, base = (
        ros.node("lab_behavior.talk", f"/lab/{n[:-3]}_{n[-2]}", member=n) for n in names
    )
    for node in ros.nodes:
        node.wait_in("Silent")
    fakes.listeners("/lab/go", "/lab/asked", "/lab/answer", count=3)

    fakes.publish("/lab/go", name="robot[1]", speed=0.0)
    second.wait_in("Asked")
    first.wait_in("Answered")
    (asked,) = [line for line in second.trace if line["event"] == "Asked"]
    assert asked["envelope"]["sender"] == "robot[0]"
    assert asked["envelope"]["sent"] > 10**18  # since 1970
    assert (asked["sent"], asked["to"]) == (["Answer"], ["robot[0]"])
    (line,) = [line for line in first.trace if line["sent"]]
    assert (line["sent"], line["to"]) == (["Asked"], ["robot[1]"])

    # Nobody has the first two addresses. All but the base are in the role, and have been idle.
    for address in ("", "rover[0]", "robot"):
        fakes.publish("/lab/go", name=address, speed=2.0)
    first.wait_in("Asked")
    second.wait_in("Asked")
    base.wait_in("Answered")
    assert [line["event"] for line in base.trace].count("Asked") == 0
    heard = [line["event"] for line in first.trace if line["event"] in ("Asked", "Answer")]
    assert heard == ["Answer", "Asked"]
    assert "Asked is sent to nobody" in base.log


def _start(ros: Any, machine: str, namespace: str) -> Any:
    role, _, number = namespace.rpartition("/")[2].partition("_")
    altitude = {"altitude": 2.5} if role == "uav" else {}
    return ros.node(f"sar_behavior.{machine}", namespace, member=f"{role}[{number}]", **altitude)
