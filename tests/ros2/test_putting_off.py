"""Deferred events and delayed sends on a real ROS 2."""

from __future__ import annotations

from typing import Any


def test_events_that_come_early_and_words_that_are_taken_back(ros: Any) -> None:
    fakes = ros.fakes()
    fakes.publisher("/lab/job", "std_msgs/msg/Int32")
    fakes.publisher("/lab/free", "std_msgs/msg/Empty")
    hearer = ros.node("lab_behavior.hearing", "/lab/hearer_0")
    worker = ros.node("lab_behavior.working", "/lab/worker_0")
    worker.wait_in("Busy")
    hearer.wait_in("Wait")
    fakes.listeners("/lab/job", "/lab/free")

    fakes.publish("/lab/job", data=3)
    fakes.publish("/lab/job", data=4)
    worker.wait_for("Job", 2)
    fakes.publish("/lab/free")

    worker.wait_in("Told")
    jobs = [line for line in worker.trace if line["event"] == "Job"]
    assert [line["data"]["data"] for line in jobs] == [3, 4, 3, 4]
    assert [line.get("deferred", False) for line in jobs] == [True, True, False, False]
    assert [line.get("recalled", False) for line in jobs] == [False, False, True, True]
    hearer.wait_in("Heard")
    # The word that was due earlier was taken back, or it would have come first.
    assert [line["data"]["data"] for line in hearer.trace if line["event"] == "Word"] == [34]
