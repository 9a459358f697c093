"""Delivery of swarm events on a real ROS 2."""

from __future__ import annotations

from typing import Any


def test_a_node_that_comes_later_gets_the_latest_event(ros: Any) -> None:
    planner = ros.node("lab_behavior.planning", "/lab/planner_0")
    planner.wait_in("Told")

    late = ros.node("lab_behavior.joining", "/lab/scout_0")

    late.wait_in("Follow")
    assert [line["data"]["data"] for line in late.trace if line["event"] == "Plan"] == [2]


def test_a_volatile_publisher_outside_of_the_model_is_heard(ros: Any) -> None:
    scout = ros.node("lab_behavior.joining", "/lab/scout_0")
    scout.wait_in("Wait")
    outside = ros.fakes()
    outside.publisher("/lab/plan", "std_msgs/msg/Int32")
    scout.until(lambda _: "publisher that is volatile" in scout.log, "a new subscription")
    outside.listeners("/lab/plan")

    outside.publish("/lab/plan", data=2)

    scout.wait_in("Follow")
