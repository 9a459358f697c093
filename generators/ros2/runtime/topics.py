"""Events of the machine on topics of the robot and of the swarm."""

from typing import Any, NamedTuple

from builtin_interfaces.msg import Time
from rclpy.duration import Duration
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    QoSPolicyKind,
    QoSProfile,
    ReliabilityPolicy,
)
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


class Delivery(NamedTuple):
    """
    How a swarm event is delivered; times are in nanoseconds.

    `keep` is the number of messages that a publisher keeps for those who do not answer, and with
    `latest` for those who come later.
    """

    reliable: bool = True
    latest: bool = False
    keep: Any = None
    lifespan: Any = None
    deadline: Any = None


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
    delivery: Any = Delivery()


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
        self._of_swarm = {topic.event for topic in topics if topic.swarm}
        self._headers = {}
        self._subscriptions = []
        self._echoes = {}
        around = swarm.rstrip('/')
        for topic in topics:
            name = f'{around}/{topic.name}' if topic.swarm else topic.name
            if topic.sent:
                self._headers[topic.event] = _headers(topic.interface)
                wire = topic.envelope or topic.interface
                qos = sending(topic.delivery)
                self._publishers[topic.event] = self._publisher(wire, name, group, qos)
                if topic.local:
                    local = self._publisher(
                        topic.interface, topic.local, group, sending(Delivery())
                    )
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
        """
        Fill in the time and the sender in the headers of a message.

        The sender of a swarm event is this robot, also if it has the message from another one.
        """
        for field, kind in self._headers[name]:
            header = getattr(message, field)
            if kind == _OF_BRIDGE:
                header.name = header.name or self._names[name]
                if name in self._of_swarm or not header.node:
                    header.node = self._robot.id or header.node
            elif header.stamp == Time():
                header.stamp = self._node.get_clock().now().to_msg()

    def release(self):
        """Destroy all publishers and subscriptions."""
        for each in self._subscriptions:
            each.destroy()
        for publishers in (self._publishers, self._local_publishers):
            for each in publishers.values():
                self._node.destroy_publisher(each)

    def _publisher(self, interface, name, group, qos):
        return self._node.create_publisher(
            interface,
            name,
            qos,
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

    It asks for the delivery of the model until a publisher comes that offers less, such as many
    sensors, which are best effort; then it asks for no more than that.
    """

    def __init__(self, node, topic, name, group, hear, drop):
        self._node = node
        self._topic = topic
        self._name = name
        self._group = group
        self._hear = hear
        self._drop = drop
        overriding = QoSOverridingOptions.with_default_policies()
        self._made = self._subscribe(hearing(topic.delivery), qos_overriding_options=overriding)

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
        late = self._miss if self._topic.delivery.deadline is not None else None
        events = SubscriptionEventCallbacks(
            incompatible_qos=self._match, message_lost=self._lose, deadline=late
        )
        try:
            return self._node.create_subscription(*arguments, **options, event_callbacks=events)
        except UnsupportedEventTypeError:
            # The middleware does not tell what it loses; it matches all publishers.
            return self._node.create_subscription(*arguments, **options)

    def _match(self, mismatch):
        """Match a publisher that offers less."""
        earlier = self._made
        qos = earlier.qos_profile
        offered = _LESS.get(mismatch.last_policy_kind)
        if offered is None or not offered(qos):
            return
        what = _OFFERS[mismatch.last_policy_kind]
        self._node.get_logger().info(f'{self._name} has a publisher that is {what}')
        with earlier.handle:
            while (taken := earlier.handle.take_message(earlier.msg_type, False)) is not None:
                self._hear(taken[0])
        self.destroy()
        self._made = self._subscribe(qos)

    def _miss(self, missed):
        event, count = self._topic.event, missed.total_count_change
        self._node.get_logger().warning(f'{event} missed its deadline {count} times')

    def _lose(self, lost):
        self._drop(self._topic.event, lost.total_count_change, self._is_reliable)


def sending(delivery):
    """Return the QoS of a publisher of an event."""
    qos = hearing(delivery)
    if delivery.keep is not None or delivery.latest:
        qos.depth = delivery.keep or 1
    if delivery.lifespan is not None:
        qos.lifespan = Duration(nanoseconds=delivery.lifespan)
    return qos


def hearing(delivery):
    """Return the QoS of a subscription to an event, which hears from several publishers."""
    policies = {}
    if delivery.latest:
        policies['durability'] = DurabilityPolicy.TRANSIENT_LOCAL
    if delivery.deadline is not None:
        policies['deadline'] = Duration(nanoseconds=delivery.deadline)
    reliability = ReliabilityPolicy.RELIABLE
    if not delivery.reliable:
        reliability = ReliabilityPolicy.BEST_EFFORT
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=DEPTH,
        reliability=reliability,
        **policies,
    )


def _less_reliable(qos):
    before, qos.reliability = qos.reliability, ReliabilityPolicy.BEST_EFFORT
    return before is not ReliabilityPolicy.BEST_EFFORT


def _less_durable(qos):
    before, qos.durability = qos.durability, DurabilityPolicy.VOLATILE
    return before is not DurabilityPolicy.VOLATILE


def _less_timely(qos):
    before, qos.deadline = qos.deadline, Duration()
    return before != Duration()


_LESS = {
    QoSPolicyKind.RELIABILITY: _less_reliable,
    QoSPolicyKind.DURABILITY: _less_durable,
    QoSPolicyKind.DEADLINE: _less_timely,
}
"""Ask for less by policy; they return False if the QoS asked for no more already."""
_OFFERS = {
    QoSPolicyKind.RELIABILITY: 'best effort',
    QoSPolicyKind.DURABILITY: 'volatile',
    QoSPolicyKind.DEADLINE: 'without the deadline',
}


def _headers(interface):
    """Return the header fields of a message, which have its time or its sender."""
    fields = interface.get_fields_and_field_types().items()
    return [(field, kind) for field, kind in fields if kind in (_OF_ROS, _OF_BRIDGE)]
