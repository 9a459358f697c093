"""Events of the machine on topics of the robot and of the swarm."""

from typing import Any, NamedTuple

from builtin_interfaces.msg import Time
from rclpy.qos import HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.qos_overriding_options import QoSOverridingOptions

from .engine import Event
from .values import SECOND, to_json

_DEPTH = 10
_OF_ROS, _OF_BRIDGE = 'std_msgs/Header', 'swarmros/EventHeader'
_ECHO = 2 * SECOND
"""Time in which an event of the node itself may arrive on its topic, in nanoseconds."""


class Topic(NamedTuple):
    """
    An event and its topic.

    The topic of a swarm event is in the namespace of the swarm; `local` is a topic of the robot on
    which it is sent too. `reliable` events are sent again until they arrive; subscriptions to
    sensors are best effort and match any publisher.
    """

    event: str
    interface: Any
    name: str
    swarm: bool = False
    heard: bool = False
    sent: bool = False
    reliable: bool = True
    local: str = ''


class Topics:
    """The publishers and subscriptions of a node."""

    def __init__(self, node, topics, swarm, member, group, clock, hear):
        self._node = node
        self._member = member
        self._clock = clock
        self._hear = hear
        self._publishers = {}
        self._names = {topic.event: topic.name for topic in topics}
        self._headers = {}
        self._subscriptions = []
        self._echoes = {}
        around = swarm.rstrip('/')
        for topic in topics:
            name = f'{around}/{topic.name}' if topic.swarm else topic.name
            if topic.sent:
                self._headers[topic.event] = _headers(topic.interface)
                self._publishers[topic.event] = [
                    self._publisher(topic, each, group) for each in (name, topic.local) if each
                ]
            if topic.heard:
                if topic.swarm and topic.sent:
                    self._echoes[topic.event] = []
                self._subscriptions.append(
                    node.create_subscription(
                        topic.interface,
                        name,
                        self._listener(topic.event),
                        _qos(topic),
                        callback_group=group,
                        qos_overriding_options=QoSOverridingOptions.with_default_policies(),
                    )
                )

    def send(self, event):
        """Publish an event, with its time and sender in empty headers."""
        self._sign(event.data, event.name)
        if event.name in self._echoes:
            self._echoes[event.name].append((to_json(event.data), self._clock() + _ECHO))
        for publisher in self._publishers[event.name]:
            publisher.publish(event.data)

    def _sign(self, message, name):
        for field, kind in self._headers[name]:
            header = getattr(message, field)
            if kind == _OF_BRIDGE:
                header.name = header.name or self._names[name]
                header.node = header.node or self._member
            elif header.stamp == Time():
                header.stamp = self._node.get_clock().now().to_msg()

    def release(self):
        """Destroy all publishers and subscriptions."""
        for each in self._subscriptions:
            self._node.destroy_subscription(each)
        for publishers in self._publishers.values():
            for each in publishers:
                self._node.destroy_publisher(each)

    def _publisher(self, topic, name, group):
        return self._node.create_publisher(
            topic.interface,
            name,
            _qos(topic),
            callback_group=group,
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )

    def _listener(self, event):
        def listen(message):
            if not self._is_echo(event, message):
                self._hear(Event(event, message))

        return listen

    def _is_echo(self, event, message):
        """Return True for an event that the node has sent itself; swarm events are for others."""
        waited = self._echoes.get(event)
        if not waited:
            return False
        now, data = self._clock(), to_json(message)
        waited[:] = [each for each in waited if each[1] >= now]
        for each in waited:
            if each[0] == data:
                waited.remove(each)
                return True
        return False


def _headers(interface):
    """Return the header fields of a message, which have its time or its sender."""
    fields = interface.get_fields_and_field_types().items()
    return [(field, kind) for field, kind in fields if kind in (_OF_ROS, _OF_BRIDGE)]


def _qos(topic):
    reliable = topic.reliable
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=_DEPTH,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
    )
