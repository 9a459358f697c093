"""Diagnostics that nodes publish, and feedback that they get from actions."""

from __future__ import annotations

import time
from typing import Any

WORK = ("/lab/work", "lab_msgs/action/Work")
TOPIC = "/diagnostics"
OK, WARN = [0], [1]


class Watched:
    """A node of the lab, and a tool that watches it."""

    def __init__(self, ros: Any, **parameters: Any) -> None:
        self.fakes = ros.fakes()
        self.fakes.do("subscribe", topic=TOPIC, kind="diagnostic_msgs/msg/DiagnosticArray")
        self.fakes.publisher("/go", "lab_msgs/msg/Order")
        self.fakes.service("/lab/ask", "lab_msgs/srv/Ask")
        given = {"diagnostics__period": 0.1, "member": "robot[1]", **parameters}
        self.node = ros.node("lab_behavior.lab", "/lab", **given)
        self.fakes.listeners("/go")
        self.node.wait_in("Idle")

    def go(self) -> None:
        self.fakes.publish("/go", name="box", speed=1.0)

    def status(self, level: list[int], text: str) -> dict[str, Any]:
        """Wait until the node tells something on that level."""
        end = time.monotonic() + 60
        while time.monotonic() < end:
            for message in self.fakes.found("message", TOPIC):
                (status,) = message["data"]["status"]
                if status["level"] == level and text in status["message"]:
                    return dict(status)
            time.sleep(0.05)
        raise AssertionError(self.fakes.found("message", TOPIC)[-1:])


def test_how_a_node_is(ros: Any) -> None:
    watched = Watched(ros)
    watched.fakes.action(*WORK, "never")

    idle = watched.status(OK, "Idle")
    assert (idle["name"], idle["hardware_id"]) == ("lab/lab: Lab", "robot[1]")
    watched.go()
    busy = watched.status(OK, "Busy.Hands.Working, Busy.Head.Thinking.")
    assert {"key": "work on work", "value": "works"} in busy["values"]
    stamp = watched.fakes.found("message", TOPIC)[0]["data"]["header"]["stamp"]
    assert stamp["sec"] > 0


def test_a_server_that_is_missing(ros: Any) -> None:
    """It is told while it is waited for, and once when that was in vain."""
    watched = Watched(ros, timeouts__server=1.0)
    watched.go()

    waiting = watched.status(WARN, "work on work has no server yet")
    assert {"key": "work on work", "value": "waits for its server"} in waiting["values"]
    given_up = watched.status(WARN, "work on work has no server")
    assert given_up["values"][-1]["key"] == "warning"
    watched.node.wait_for("do.Busy.Hands.Working.aborted")


def test_feedback_is_an_event(ros: Any) -> None:
    """Monitored feedback of an action is stored where its guard holds."""
    watched = Watched(ros)
    shares = [{"share": 0.5}, {"share": 0.25}]
    watched.fakes.action(*WORK, {"outcome": "never", "feedback": shares})
    watched.go()

    first = watched.node.wait_for("WorkFeedback")
    second = watched.node.wait_for("WorkFeedback", 2)
    assert [line["data"]["feedback"]["share"] for line in (first, second)] == [0.5, 0.25]
