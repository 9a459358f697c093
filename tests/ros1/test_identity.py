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
