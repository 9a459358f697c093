"""Nodes come, go and come again while a preview listens, in a graph of ROS 2 that is made up."""

from __future__ import annotations

import json
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest

from swarmdsl.ide.preview.ros2 import _Ears
from swarmdsl.ide.preview.serving import News


class Graph:
    """A node in a graph with one other, whose publishers have the ids `there`."""

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
        self, kind: Any, topic: str, hear: Callable[[Any], None], qos: Any
    ) -> str:
        assert topic not in self.heard
        self.heard[topic] = hear
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
    """The news that pages would be told: where the robot is, None where it is gone."""

    def __init__(self) -> None:
        self.places: list[Any] = []

    def move(self, name: str, active: dict[str, Any], taken: Any) -> None:
        self.places.append([*active["dog[0]"]])

    def forget(self, name: str) -> None:
        self.places.append(None)


def listening(graph: Graph, news: Any) -> _Ears:
    qos = SimpleNamespace(
        QoSProfile=lambda **chosen: chosen, DurabilityPolicy=SimpleNamespace(TRANSIENT_LOCAL=1)
    )
    return _Ears(qos, None, graph, ["/yard"], news, pytest.fail)


def test_a_machine_alone_is_called_as_its_node_whoever_else_is_there() -> None:
    graph, news = Graph(), News()
    ears = listening(graph, news)
    graph.there = {1}
    ears.look()
    graph.say("transitions", "Lie", member=None)
    assert next(news.follow()) == [{"active": {"/yard/dog": ["Lie"]}}]


@pytest.mark.parametrize("between", [set(), {1, 2}], ids=["ended", "killed"])
def test_a_node_that_starts_again_between_two_looks(between: set[int]) -> None:
    graph, told = Graph(), Told()
    ears = listening(graph, told)
    ears.look()
    assert not graph.heard
    graph.there = {1}
    ears.look()
    graph.say("state", "Lie")
    graph.say("transitions", "Walk")
    graph.say("state", "Lie")  # what was said before, late
    ears.look()
    assert told.places == [["Lie"], ["Walk"]]
    # A node that is killed is in the graph still when the next one comes.
    graph.there = between or {2}
    ears.look()
    graph.say("state", "Lie")
    graph.there = {2}
    ears.look()
    assert told.places[2:] == [None, ["Lie"]]
    graph.there = set()
    ears.look()
    assert told.places[4:] == [None]
    assert not graph.heard
