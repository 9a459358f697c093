"""Events that come faster than a node processes them, or that the network loses."""

from __future__ import annotations

import signal
from typing import Any

import pytest

NOISE = ("/lab/noise", "lab_msgs/msg/Report")
HEARD = ("/lab/heard", "lab_msgs/msg/Report")
DIAGNOSTICS = ("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray")
# Messages of the size of a picture, which fill the buffers of a process that stands still.
MANY, LARGE = 60, 25_000


class Tally:
    """A node that counts what it hears, and who makes noise."""

    def __init__(self, ros: Any, **qos: Any) -> None:
        self.fakes = ros.fakes()
        self.fakes.publisher(*NOISE, **qos)
        self.node = ros.node("lab_behavior.tally", "/lab", diagnostics__period=0.1)
        self.fakes.listeners(NOISE[0])
        self.node.wait_in("Counting")

    def burst(self, count: int, size: int = 1) -> None:
        """Publish messages as fast as possible."""
        before = self.fakes.count("burst", NOISE[0])
        self.fakes.do("burst", topic=NOISE[0], field="history", count=count, size=size)
        self.fakes.wait("burst", NOISE[0], before + 1)

    @property
    def heard(self) -> list[int]:
        """The numbers of the messages that the node has heard."""
        lines = [line for line in self.node.trace if line["event"] == "Noise"]
        return [line["data"]["history"][0] for line in lines]

    @property
    def lost(self) -> int:
        """Return the number of messages that are lost, by the trace."""
        lines = [line for line in self.node.trace if line["event"] == "node.lost"]
        return sum(line["data"]["Noise"] for line in lines)


def test_a_burst_of_events_that_no_machine_sends_is_heard_whole(ros: Any) -> None:
    tally = Tally(ros, depth=1000)
    tally.burst(500)

    tally.node.wait_for("Noise", 500)
    assert tally.heard == list(range(500))


def test_what_a_node_sends_waits_for_a_listener_that_is_busy(ros: Any) -> None:
    listener = ros.fakes()
    listener.do("subscribe", topic=HEARD[0], kind=HEARD[1])
    listener.publisher(*NOISE)
    tally = Tally(ros, depth=1000)
    listener.listeners(NOISE[0])
    listener.process.send_signal(signal.SIGSTOP)
    tally.burst(MANY, LARGE)
    tally.node.wait_for("Noise", MANY)
    listener.process.send_signal(signal.SIGCONT)

    listener.wait("message", HEARD[0], MANY)


@pytest.mark.parametrize("reliable", [True, False], ids=["reliable", "best effort"])
def test_events_that_are_lost_are_told(ros: Any, reliable: bool) -> None:
    """A node that stands still loses what its publisher does not keep."""
    tally = Tally(ros, depth=5, reliable=reliable)
    tally.fakes.do("subscribe", topic=DIAGNOSTICS[0], kind=DIAGNOSTICS[1])
    if not reliable:
        tally.burst(1)
        tally.node.wait_for("Noise")
    known = len(tally.heard)
    tally.node.process.send_signal(signal.SIGSTOP)
    tally.burst(MANY, LARGE)
    tally.node.process.send_signal(signal.SIGCONT)
    tally.node.until(lambda _: len(tally.heard) > known, "the first of the burst")
    tally.fakes.publish(NOISE[0], history=[MANY])

    def is_complete(_: Any) -> bool:
        return tally.lost > 0 and len(tally.heard) - known + tally.lost == MANY + 1

    tally.node.until(is_complete, "heard and lost")
    warning = f"messages were lost: {tally.lost} of Noise"
    assert (warning in tally.node.log) == reliable
    value = {"key": "lost messages of Noise", "value": str(tally.lost)}
    before = tally.fakes.count("message", DIAGNOSTICS[0])
    (status,) = tally.fakes.wait("message", DIAGNOSTICS[0], before + 2)["data"]["status"]
    assert value in status["values"]


def test_publishers_of_both_kinds_are_heard_on_one_topic(ros: Any) -> None:
    tally = Tally(ros)
    tally.fakes.publish(NOISE[0], history=[1])
    tally.node.wait_for("Noise")
    sensor = ros.fakes()
    sensor.publisher(*NOISE, reliable=False)
    sensor.listeners(NOISE[0])
    sensor.publish(NOISE[0], history=[2])
    tally.node.wait_for("Noise", 2)
    tally.fakes.publish(NOISE[0], history=[3])
    tally.node.wait_for("Noise", 3)

    assert tally.heard == [1, 2, 3]
    assert "noise has a publisher that is best effort" in tally.node.log
