"""Events of the machine on topics of the robot and of the swarm."""

from typing import Any, NamedTuple

from builtin_interfaces.msg import Time
from rclpy.qos import HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.qos_overriding_options import QoSOverridingOptions

from .engine import Envelope, Event
from .values import get, SECOND, to_json

try:
    from rclpy.event_handler import SubscriptionEventCallbacks, UnsupportedEventTypeError
except ImportError:  # humble
    from rclpy.qos_event import SubscriptionEventCallbacks, UnsupportedEventTypeError

DEPTH = 10_000
"""Number of messages of an event that may wait; a burst is heard whole, as in ROS 1."""
_OF_ROS, _OF_BRIDGE = 'std_msgs/Header', 'swarmros/EventHeader'
_ECHO = 2 * SECOND
"""Time in which an event of the node itself may arrive on its topic, in nanoseconds."""


class Topic(NamedTuple):
    """
    An event and its topic.

    The topic of a swarm event is in the namespace of the swarm; `local` is a topic of the robot on
    which it is sent too. `envelope` is the interface of a message around it with its sender, its
    time and its address, if a machine asks for them.
    """

    event: str
    interface: Any
    name: str
    swarm: bool = False
    heard: bool = False
    sent: bool = False
    local: str = ''
    envelope: Any = None


class Topics:
    """
    The publishers and subscriptions of a node.

    `hear` is called with each event, `drop` with the name of an event, the number of its messages
    that were lost, and whether they were sent reliably.
    """

    def __init__(self, node, topics, swarm, robot, group, clock, hear, drop):
        self._node = node
        self._robot = robot
        self._clock = clock
        self._hear = hear
        self._publishers = {}
        self._local_publishers = {}
        self._names = {topic.event: topic.name for topic in topics}
        self._envelopes = {topic.event: topic.envelope for topic in topics if topic.envelope}
        self._headers = {}
        self._subscriptions = []
        self._echoes = {}
        around = swarm.rstrip('/')
        for topic in topics:
            name = f'{around}/{topic.name}' if topic.swarm else topic.name
            if topic.sent:
                self._headers[topic.event] = _headers(topic.interface)
                wire = topic.envelope or topic.interface
                self._publishers[topic.event] = self._publisher(wire, name, group)
                if topic.local:
                    local = self._publisher(topic.interface, topic.local, group)
                    self._local_publishers[topic.event] = local
            if topic.heard:
                if topic.swarm and topic.sent:
                    self._echoes[topic.event] = []
                hear_event = self._listener(topic)
                self._subscriptions.append(
                    _Subscription(node, topic, name, group, hear_event, drop)
                )

    def send(self, event):
        """
        Publish an event, with its time and sender in empty headers.

        An empty address is that of nobody.
        """
        to = event.envelope.to
        if to == '':
            what = f'{event.name} is sent to nobody: its address is empty'
            self._node.get_logger().warning(what)
            return
        self._sign(event.data, event.name)
        wire = self._wrapped(event)
        if event.name in self._echoes:
            self._echoes[event.name].append((to_json(wire), self._clock() + _ECHO))
        self._publishers[event.name].publish(wire)
        if to is None and event.name in self._local_publishers:
            self._local_publishers[event.name].publish(event.data)

    def _wrapped(self, event):
        """Return the message that is published: an event is in its envelope, if it has one."""
        if event.name not in self._envelopes:
            return event.data
        return self._envelopes[event.name](
            sender=self._robot.id,
            sent=self._node.get_clock().now().to_msg(),
            to=event.envelope.to or '',
            message=event.data,
        )

    def _sign(self, message, name):
        for field, kind in self._headers[name]:
            header = getattr(message, field)
            if kind == _OF_BRIDGE:
                header.name = header.name or self._names[name]
                header.node = header.node or self._robot.id
            elif header.stamp == Time():
                header.stamp = self._node.get_clock().now().to_msg()

    def release(self):
        """Destroy all publishers and subscriptions."""
        for each in self._subscriptions:
            each.destroy()
        for publishers in (self._publishers, self._local_publishers):
            for each in publishers.values():
                self._node.destroy_publisher(each)

    def _publisher(self, interface, name, group):
        return self._node.create_publisher(
            interface,
            name,
            reliable(),
            callback_group=group,
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )

    def _listener(self, topic):
        def listen(message):
            if not self._is_echo(topic.event, message):
                self._hear(Event(topic.event, message))

        def open_envelope(message):
            if not self._is_echo(topic.event, message) and self._is_for_me(message):
                to = message.to or None
                envelope = Envelope(message.sender, get(message, 'sent'), to)
                self._hear(Event(topic.event, message.message, envelope=envelope))

        return open_envelope if topic.envelope else listen

    def _is_for_me(self, message):
        """Return True for an event of another robot to this one, to its role or to all."""
        if message.sender and message.sender == self._robot.id:
            return False
        return message.to in ('', self._robot.id, self._robot.role)

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


class _Subscription:
    """
    A subscription to an event, which matches every publisher.

    It is reliable, and a message that the network drops is sent again, until a publisher comes
    that is best effort, such as many sensors; then it is best effort.
    """

    def __init__(self, node, topic, name, group, hear, drop):
        self._node = node
        self._topic = topic
        self._name = name
        self._group = group
        self._hear = hear
        self._drop = drop
        overriding = QoSOverridingOptions.with_default_policies()
        self._made = self._subscribe(reliable(), qos_overriding_options=overriding)

    def destroy(self):
        """End the subscription."""
        self._node.destroy_subscription(self._made)

    @property
    def _is_reliable(self):
        return self._made.qos_profile.reliability is not ReliabilityPolicy.BEST_EFFORT

    def _subscribe(self, qos, **options):
        options.update(callback_group=self._group)
        interface = self._topic.envelope or self._topic.interface
        arguments = (interface, self._name, self._hear, qos)
        events = SubscriptionEventCallbacks(incompatible_qos=self._match, message_lost=self._lose)
        try:
            return self._node.create_subscription(*arguments, **options, event_callbacks=events)
        except UnsupportedEventTypeError:
            # The middleware does not tell what it loses; it matches all publishers.
            return self._node.create_subscription(*arguments, **options)

    def _match(self, _):
        """Match a publisher that is best effort."""
        if not self._is_reliable:
            return
        self._node.get_logger().info(f'{self._name} has a publisher that is best effort')
        earlier = self._made
        with earlier.handle:
            while (taken := earlier.handle.take_message(earlier.msg_type, False)) is not None:
                self._hear(taken[0])
        self.destroy()
        qos = earlier.qos_profile
        qos.reliability = ReliabilityPolicy.BEST_EFFORT
        self._made = self._subscribe(qos)

    def _lose(self, lost):
        self._drop(self._topic.event, lost.total_count_change, self._is_reliable)


def reliable():
    """Return the QoS of events."""
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=DEPTH,
        reliability=ReliabilityPolicy.RELIABLE,
    )


def _headers(interface):
    """Return the header fields of a message, which have its time or its sender."""
    fields = interface.get_fields_and_field_types().items()
    return [(field, kind) for field, kind in fields if kind in (_OF_ROS, _OF_BRIDGE)]
