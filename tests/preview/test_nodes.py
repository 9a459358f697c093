"""Tests of nodes that start, end and restart during a preview, in a fake ROS graph."""

from __future__ import annotations

import json
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest

from swarmdsl.ide.preview.live_trace import TraceReader
from swarmdsl.ide.preview.ros2 import NodeListener, Ros, _NodeTrace
from swarmdsl.ide.preview.serving import Snapshot


class Graph:
    """Node in a graph with one other node, whose publishers have the ids `there`."""

    def __init__(self) -> None:
        self.there: set[int] = set()
        self.heard: dict[str, Callable[[Any], None]] = {}

    def get_topic_names_and_types(self) -> list[tuple[str, list[str]]]:
        topics = ("/yard/dog/transitions", "/yard/dog/state", "/yard/seen")
        return [(topic, ["std_msgs/msg/String"]) for topic in topics]

    def get_publishers_info_by_topic(self, topic: str) -> list[Any]:
        assert topic == "/yard/dog/transitions"
        return [SimpleNamespace(endpoint_gid=[each, 0]) for each in self.there]

    def create_subscription(
        self, kind: Any, topic: str, read: Callable[[Any], None], qos: Any
    ) -> str:
        assert topic not in self.heard
        self.heard[topic] = read
        return topic

    def destroy_subscription(self, topic: str) -> None:
        del self.heard[topic]

    def say(self, topic: str, *configuration: str, member: str | None = "dog[0]") -> None:
        said: dict[str, Any] = {"member": member, "configuration": configuration}
        if topic == "transitions":
            names = ("entered", "exited", "taken", "started", "cancelled", "sent")
            said = {"t": 0, "event": None, **{name: [] for name in names}, **said}
        self.heard[f"/yard/dog/{topic}"](SimpleNamespace(data=json.dumps(said)))


class Told:
    """Records the states of a robot; None when it ended."""

    def __init__(self) -> None:
        self.places: list[Any] = []

    def move(self, name: str, active: dict[str, Any], taken: Any) -> None:
        self.places.append([*active["dog[0]"]])

    def forget(self, name: str) -> None:
        self.places.append(None)


def listening(graph: Graph, snapshot: Any) -> NodeListener:
    qos = SimpleNamespace(
        QoSProfile=lambda **chosen: chosen, DurabilityPolicy=SimpleNamespace(TRANSIENT_LOCAL=1)
    )
    return NodeListener(
        Ros(qos, None),
        graph,
        ["/yard"],
        lambda owner: _NodeTrace(TraceReader(owner, True, snapshot, pytest.fail)),
    )


def test_machine_outside_of_a_swarm_is_named_after_its_node() -> None:
    graph, snapshot = Graph(), Snapshot()
    listener = listening(graph, snapshot)
    graph.there = {1}
    listener.poll()
    graph.say("transitions", "Lie", member=None)
    assert next(snapshot.follow()) == [{"active": {"/yard/dog": ["Lie"]}}]


@pytest.mark.parametrize("between", [set(), {1, 2}], ids=["ended", "killed"])
def test_node_restarts_between_two_polls(between: set[int]) -> None:
    graph, told = Graph(), Told()
    listener = listening(graph, told)
    listener.poll()
    assert not graph.heard
    graph.there = {1}
    listener.poll()
    graph.say("state", "Lie")
    graph.say("transitions", "Walk")
    graph.say("state", "Lie")  # a late message of the old node
    listener.poll()
    assert told.places == [["Lie"], ["Walk"]]
    # A killed node is still in the graph when its successor starts.
    graph.there = between or {2}
    listener.poll()
    graph.say("state", "Lie")
    graph.there = {2}
    listener.poll()
    assert told.places[2:] == [None, ["Lie"]]
    graph.there = set()
    listener.poll()
    assert told.places[4:] == [None]
    assert not graph.heard
