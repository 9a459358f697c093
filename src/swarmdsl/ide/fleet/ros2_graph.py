"""Fleet in a graph of ROS 2: lines of nodes, heartbeats, batteries, verdicts, and what is sent."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from time import time_ns
from typing import Any

from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.ide.fleet.operator_events import OperatorEvent
from swarmdsl.ide.fleet.ros2_messages import fill, message_class
from swarmdsl.ide.fleet.sensed import BATTERY, TYPES, moved_line, place_of, share_of
from swarmdsl.ide.fleet.told_lines import TOPICS, member_in, model_in, time_of
from swarmdsl.ide.fleet.watch import NotSentError, Watch
from swarmdsl.ide.preview.ros2 import Listen, NodeListener, Ros

_MILLISECOND = 1_000_000
_STRING = "std_msgs/msg/String"
_LOOKS = 2
"""Looks for which lines wait after a node was found: others may have older ones."""
_ENVELOPE = {"sender", "sent", "to", "message"}
"""Fields of the message around an event of which robots ask who has sent it."""


def listen_to(names: Sequence[str], watch: Watch) -> Listen:
    """Return what adds nodes with these names, or in these namespaces, to a watch."""

    def listen(ros: Ros, node: Any) -> Callable[[], None]:
        return _Graph(ros, node, names, watch).look

    return listen


class _Graph:
    """Subscriptions to what robots tell, and publishers of what a person may send."""

    def __init__(self, ros: Ros, node: Any, names: Sequence[str], watch: Watch) -> None:
        self._ros, self._node, self._watch = ros, node, watch
        self._spaces = [f"/{name.strip('/')}".rstrip("/") for name in names]
        self._nodes = NodeListener(ros, node, names, self._begun, history=True)
        self._lines: list[str] = []
        self._wait = 0
        self._robots: dict[str, str] = {}
        """Robots by their namespaces."""
        self._places: dict[str, tuple[float, float, float]] = {}
        self._moved: dict[str, tuple[float, float, float]] = {}
        """Places of robots that have moved since the last look."""
        self._swarms: dict[str, None] = {}
        """Namespaces of swarms."""
        self._heard: set[str] = set()
        self._publishers: dict[str, list[Any]] = {each.name: [] for each in watch.events}
        self._sending: set[str] = set()
        self._faults: dict[str, str] = {}
        watch.send_with(self._send)

    def look(self) -> None:
        """Look for nodes and topics that are new or gone; tell what has come."""
        self._nodes.poll()
        known = dict(self._node.get_topic_names_and_types())
        for topic, types in known.items():
            if topic not in self._heard and self._is_followed(topic):
                self._hear(topic, types)
        for space in self._swarms:
            self._offer(space, known)
        self._flush()

    # ---- what comes

    def _begun(self, owner: str) -> _NodeLines:
        self._wait = _LOOKS
        return _NodeLines(owner, self)

    def on_line(self, text: str) -> None:
        """Keep a line until the next look."""
        self._lines.append(text)

    def on_member(self, member: str, owner: str) -> None:
        """Note the robot of a node."""
        robot = Robot.called(member.partition(".")[0])
        name = f"{robot.role}_{robot.index}"
        space, found, _ = f"{owner}/".partition(f"/{name}/")
        if robot.role and found:
            self._swarms[space] = None
            self._robots[f"{space}/{name}"] = robot.name or member
        with self._watch.noting() as standing:
            standing.begin(member, owner)

    def on_end(self, owner: str) -> None:
        """Note that a node is gone."""
        self._wait = 0
        self._flush()
        with self._watch.noting() as standing:
            standing.end(owner)

    def _flush(self) -> None:
        """Tell the lines in the order of their times."""
        if self._wait:
            self._wait -= 1
            return
        if self._moved:
            self._lines.append(moved_line(self._moved, time_ns() // _MILLISECOND))
            self._moved = {}
        lines, self._lines = self._lines, []
        # Even without lines: a heartbeat may be late.
        self._watch.read(sorted(lines, key=time_of))

    def _is_followed(self, topic: str) -> bool:
        around = topic.rpartition("/")[0]
        of_swarms = around in self._swarms
        return of_swarms or any(topic.startswith(f"{space}/") for space in self._spaces)

    def _hear(self, topic: str, types: Sequence[str]) -> None:
        last = topic.rpartition("/")[2]
        if _STRING in types and last in TOPICS:
            told = {
                "verdicts": self._on_verdict,
                "members": self._on_beat,
                "models": self._on_model,
            }
            self._listen(topic, self._ros.string, told[last], latched=last != "members")
        for each in TYPES:
            if each in types:
                self._hear_sensor(topic, each)

    def _hear_sensor(self, topic: str, type_: str) -> None:
        robot = next((name for at, name in self._robots.items() if topic.startswith(f"{at}/")), "")
        if not robot:
            return  # its node may be found later
        self._heard.add(topic)
        try:
            kind = message_class(type_)
        except (ImportError, AttributeError):
            return  # it is not installed here
        tell = self._on_battery if type_ == BATTERY else self._on_place
        self._listen(topic, kind, lambda message: tell(robot, message))

    def _listen(
        self, topic: str, kind: Any, tell: Callable[[Any], None], *, latched: bool = False
    ) -> None:
        self._heard.add(topic)
        qos = self._ros.qos
        # A subscription that asks for less hears everyone.
        given = (
            {"durability": qos.DurabilityPolicy.TRANSIENT_LOCAL}
            if latched
            else {"reliability": qos.ReliabilityPolicy.BEST_EFFORT}
        )
        self._node.create_subscription(kind, topic, tell, qos.QoSProfile(depth=1000, **given))

    def _on_verdict(self, message: Any) -> None:
        self.on_line(message.data)

    def _on_beat(self, message: Any) -> None:
        with self._watch.noting() as standing:
            standing.beat(message.data)

    def _on_model(self, message: Any) -> None:
        told = model_in(message.data)
        if told is not None:
            with self._watch.noting() as standing:
                standing.tell_model(*told)

    def _on_battery(self, robot: str, message: Any) -> None:
        with self._watch.noting() as standing:
            standing.charge(robot, share_of(message))

    def _on_place(self, robot: str, message: Any) -> None:
        place = place_of(message)
        if place is not None and self._places.get(robot) != place:
            self._places[robot] = self._moved[robot] = place

    # ---- what is sent

    def _offer(self, space: str, known: Mapping[str, Sequence[str]]) -> None:
        """Make publishers before they are needed: robots must find them."""
        for each in self._watch.events:
            topic = f"{space}/{each.event.topic.lstrip('/')}"
            if topic in self._sending or topic not in known:
                continue
            self._sending.add(topic)
            try:
                kind = message_class(known[topic][0])
            except (ImportError, AttributeError, ValueError) as error:
                self._faults[each.name] = f"{known[topic][0]} is not installed here: {error}"
                continue
            publisher = self._node.create_publisher(kind, topic, self._qos(each))
            self._publishers[each.name].append((publisher, kind))

    def _qos(self, event: OperatorEvent) -> Any:
        qos, delivery = self._ros.qos, event.event.delivery
        given: dict[str, Any] = {}
        if delivery is not None and delivery.reliable is False:
            given["reliability"] = qos.ReliabilityPolicy.BEST_EFFORT
        if delivery is not None and delivery.latest:
            given["durability"] = qos.DurabilityPolicy.TRANSIENT_LOCAL
        for name in ("lifespan", "deadline"):
            time = getattr(delivery, name, None)
            if time is not None:
                given[name] = import_module("rclpy.duration").Duration(nanoseconds=time)
        return qos.QoSProfile(depth=(delivery.keep if delivery else None) or 10, **given)

    def _send(self, event: OperatorEvent, fields: Mapping[str, Any]) -> int:
        if event.name in self._faults:
            raise NotSentError(self._faults[event.name])
        publishers = self._publishers[event.name]
        heard: int = sum(each.get_subscription_count() for each, _ in publishers)
        if not heard:
            raise NotSentError(f"no node listens to `{event.name}`")
        try:
            messages = [(each, self._message(kind, fields)) for each, kind in publishers]
            for publisher, message in messages:
                publisher.publish(message)
        except (ValueError, TypeError, OverflowError, AssertionError) as error:
            # Some values do not fit into their types; ROS says it when it writes them.
            raise NotSentError(f"`{event.name}` has another message: {error}") from None
        return heard

    def _message(self, kind: Any, fields: Mapping[str, Any]) -> Any:
        message = kind()
        if set(kind.get_fields_and_field_types()) != _ENVELOPE:
            return fill(message, fields)
        # A person is no robot of the swarm: `event.sender` is empty.
        message.sent = self._node.get_clock().now().to_msg()
        fill(message.message, fields)
        return message


class _NodeLines:
    """Messages of one node."""

    def __init__(self, owner: str, graph: _Graph) -> None:
        self._owner, self._graph = owner, graph
        self._member = ""

    def on_transition(self, message: Any) -> None:
        member = member_in(message.data) or self._owner
        if member != self._member:
            self._member = member
            self._graph.on_member(member, self._owner)
        self._graph.on_line(message.data)

    def on_state(self, message: Any) -> None:
        """Leave it: the lines that the node has kept say more."""

    def on_end(self) -> None:
        self._graph.on_end(self._owner)
