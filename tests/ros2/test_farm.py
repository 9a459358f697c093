"""A scout of the agricultural swarm is killed on a real ROS 2, and the others go on without it."""

from __future__ import annotations

import signal
from typing import Any

ROBOTS = ("scout[0]", "scout[1]", "base[0]")


def robot(ros: Any, machine: str, member: str, **parameters: Any) -> Any:
    """Start the node of a robot of the farm, with a heart that beats fast."""
    return ros.node(
        f"farm_behavior.{machine}",
        f"/field/{member[:-1].replace('[', '_')}",
        member=member,
        self__count=2 if member.startswith("scout") else 1,
        heartbeat__period=0.2,
        heartbeat__timeout=5.0,
        heartbeat__members=" ".join(ROBOTS),
        **parameters,
    )


def test_a_scout_that_is_killed_at_the_dock_leaves_it_to_the_next_one(ros: Any) -> None:
    """The base notices it and lets the other one in, which then flies higher, as it is alone."""
    fakes = ros.fakes()
    for number in range(2):
        space = f"/field/scout_{number}"
        fakes.action(f"{space}/survey", "farm_interfaces/action/Survey", "never")
        fakes.service(f"{space}/fly_home", "std_srvs/srv/Trigger")
        # The battery of the first is never swapped.
        swap = "succeeded" if number else "never"
        fakes.service(f"{space}/swap_battery", "std_srvs/srv/Trigger", swap)
        fakes.publisher(f"{space}/battery/low", "std_msgs/msg/Empty")
    base = robot(ros, "farm", "base[0]")
    first, second = (
        robot(ros, "scouting", f"scout[{number}]", altitude=8.0, strips=4) for number in range(2)
    )
    for scout in (first, second):
        scout.wait_in("Work.Survey")
    base.wait_in("Running.Auction.Idle", "Running.Dock.Free", "Running.Watch.Dry")
    fakes.listeners("/field/scout_0/battery/low", "/field/scout_1/battery/low")
    goal = fakes.wait("goal", "/field/scout_1/survey")
    assert goal["data"] == {"strip": 4, "altitude": 8.0}

    fakes.publish("/field/scout_0/battery/low")
    first.wait_in("Swap.Dock")
    fakes.publish("/field/scout_1/battery/low")
    second.wait_in("Swap.Queue")
    base.wait_for("DockWanted", 2)
    first.process.send_signal(signal.SIGKILL)

    for node in (base, second):
        assert node.wait_for("member_lost")["data"] == {"id": "scout[0]", "role": "scout"}
    second.wait_for("DockFree")
    goal = fakes.wait("goal", "/field/scout_1/survey", 2)
    assert goal["data"] == {"strip": 4, "altitude": 16.0}
    base.wait_for("DockLeft")
    asked = [line for line in base.trace if line["event"] == "DockWanted"]
    assert [line.get("deferred", False) for line in asked] == [False, True, False]
    assert [line["envelope"]["sender"] for line in asked] == ["scout[0]", "scout[1]", "scout[1]"]
