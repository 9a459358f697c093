"""Heartbeats on a real ROS 2: robots that are killed, and that come back."""

from __future__ import annotations

import signal
from typing import Any

ALL = "guard[0] guard[1] clerk[0]"


def robot(ros: Any, module: str, role: str, number: int, **parameters: Any) -> Any:
    """Start the node of a robot of the swarm."""
    return ros.node(
        f"lab_behavior.{module}",
        f"/night/{role}_{number}",
        heartbeat__period=0.2,
        heartbeat__timeout=5.0,
        **{"member": f"{role}[{number}]", "heartbeat__members": ALL, **parameters},
    )


def test_a_robot_that_is_killed_and_starts_again(ros: Any) -> None:
    guard, other = (robot(ros, "guarding", "guard", number) for number in range(2))
    clerk = robot(ros, "noting", "clerk", 0)
    for node, state in ((guard, "Watch"), (other, "Watch"), (clerk, "Listen")):
        node.wait_in(state)
    other.process.send_signal(signal.SIGKILL)

    lost = guard.wait_for("member_lost")
    assert lost["data"] == {"id": "guard[1]", "role": "guard"}
    assert clerk.wait_for("Seen")["data"] == {"data": 2}

    robot(ros, "guarding", "guard", 1)
    joined = guard.wait_for("member_joined")
    assert joined["data"] == {"id": "guard[1]", "role": "guard"}
    assert clerk.wait_for("Seen", 2)["data"] == {"data": 2}


def test_a_robot_that_never_starts_is_lost(ros: Any) -> None:
    guard = robot(ros, "guarding", "guard", 0, heartbeat__members="guard[0] clerk[0]")

    assert guard.wait_for("member_lost")["data"] == {"id": "clerk[0]", "role": "clerk"}


def test_a_robot_that_nobody_expects_joins(ros: Any) -> None:
    guard = robot(ros, "guarding", "guard", 0, heartbeat__members="guard[0] clerk[0]")
    guard.wait_for("member_lost")

    robot(ros, "guarding", "guard", 1)

    assert guard.wait_for("member_joined")["data"] == {"id": "guard[1]", "role": "guard"}


def test_a_robot_is_there_while_one_of_its_nodes_is(ros: Any) -> None:
    guard = robot(ros, "guarding", "guard", 0)
    body = robot(ros, "noting", "clerk", 0)
    part = robot(ros, "noting", "clerk", 0, member="clerk[0].hand")
    other = robot(ros, "guarding", "guard", 1)
    for node, state in ((body, "Listen"), (part, "Listen"), (guard, "Watch"), (other, "Watch")):
        node.wait_in(state)
    for node in (body, other):
        node.process.send_signal(signal.SIGKILL)

    # Both were killed at once, and the clerk is heard by its hand alone.
    guard.wait_for("member_lost")
    robot(ros, "guarding", "guard", 1)
    guard.wait_for("member_joined")

    assert {line["data"]["id"] for line in guard.trace if "data" in line} == {"guard[1]"}


def test_a_machine_without_heartbeats_is_warned_of(ros: Any) -> None:
    guard = ros.node("lab_behavior.guarding", "/night/guard_0", member="guard[0]")
    guard.wait_in("Watch")

    assert "no robot is heard: parameter `heartbeat.period`" in guard.log
