"""Nodes that know their robot, under a real master."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

MODEL = """
package lab
event Go    : std_msgs/String
event Named : std_msgs/String
event Count : std_msgs/UInt32
statemachine Roll {
  var mine : uint32 = self.index
  initial Silent
  state Silent {
    on Go [event.data == self.id] /
      send Named(data = self.role), send Count(data = mine + self.count) -> Heard
  }
  final Heard
}
"""


@pytest.mark.parametrize(
    ("params", "count"), [({"self__count": 5}, 6), ({}, 3)], ids=["launched", "alone"]
)
def test_a_node_knows_its_robot(
    world: Callable[..., Any], params: dict[str, int], count: int
) -> None:
    lab = world(MODEL)
    node = lab.node("roll", member="uav[1]", **params)
    node.wait_in("Silent")
    lab.hears("Named")
    lab.hears("Count")
    lab.publish("Go", data="uav[2]")
    lab.publish("Go", data="uav[1]")
    assert lab.sent("Named") == {"data": "uav"}
    assert lab.sent("Count") == {"data": count}
    assert node.ended() == 0


TALK = """
package lab
swarm event Ask  : std_msgs/String
swarm event Tell : std_msgs/String
statemachine Talk {
  param none : string = ""
  var who : string = ""
  initial Silent
  state Silent {
    on Ask [event.sender != self.id and event.sent > 1 s]
      / who = event.sender, send Tell(data = event.sender) to event.sender -> Heard
  }
  state Heard {
    on Tell [event.sender == who] / send Ask(data = who) to base, send Tell to none -> End
  }
  final End
}
"""


def test_a_node_answers_the_one_that_asked(world: Callable[..., Any]) -> None:
    lab = world(TALK)
    node = lab.node("talk", member="uav[1]")
    node.wait_in("Silent")
    lab.hears("Ask")
    lab.hears("Tell")
    about = {"sender": "uav[0]", "sent": {"secs": 5, "nsecs": 0}}
    lab.publish("Ask", **about, to="uav[2]", message={"data": "for another"})
    lab.publish("Ask", **{**about, "sender": "uav[1]"}, to="", message={"data": "its own"})
    lab.publish("Ask", **about, to="uav", message={"data": "for its role"})
    told = lab.sent("Tell")
    assert (told["sender"], told["to"]) == ("uav[1]", "uav[0]")
    assert told["message"] == {"data": "uav[0]"}
    lab.publish("Tell", **about, to="uav[1]", message={"data": ""})
    asked = lab.sent("Ask")
    assert (asked["sender"], asked["to"]) == ("uav[1]", "base")
    assert node.ended() == 0
