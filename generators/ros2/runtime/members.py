"""Members of the swarm: heartbeats of this robot, and which other robots are heard."""

from collections import namedtuple

from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String

from .engine import Event
from .parameters import Parameter

SETTINGS = (
    Parameter('heartbeat.period', 'duration', 0.0, 'Time between heartbeats, in s; 0: none.'),
    Parameter('heartbeat.timeout', 'duration', 0.0, 'Silence after which a robot is lost, in s.'),
    Parameter('heartbeat.members', 'string', '', 'Robots at the start, divided by spaces.'),
)
JOINED, LOST = 'member_joined', 'member_lost'
_TOPIC = 'members'
_SENDING = QoSProfile(depth=1)
_HEARING = QoSProfile(depth=1000, reliability=ReliabilityPolicy.BEST_EFFORT)
"""A reliable subscription waits for each lost heartbeat, and hears none meanwhile."""


class Member(namedtuple('Member', ('id', 'role'))):
    """A robot of the swarm: the data of an event about it."""

    __slots__ = ()

    @classmethod
    def called(cls, name):
        """Return the robot with a name, such as `uav[1]`."""
        return cls(name, name.partition('[')[0] if name.endswith(']') else '')

    @classmethod
    def get_fields_and_field_types(cls):
        """Return the types of its fields, as a message does."""
        return dict.fromkeys(cls._fields, 'string')


class Members:
    """
    Sends the heartbeats of this robot, and hears those of others if `hear` is not None.

    `hear` is called with each event about another robot. Nodes of one robot share its name: it is
    there while one of them is. Only robots are heard for which `counts` is true.
    """

    def __init__(self, node, settings, swarm, robot, group, alarms, hear, counts):
        self._node = node
        self._robot = robot
        self._alarms = alarms
        self._hear = hear
        self._counts = counts
        self._period = settings['heartbeat.period']
        self._timeout = settings['heartbeat.timeout']
        self._first = settings['heartbeat.members'].split()
        self._heard = {}
        self._waits = {}
        self._beat = None
        self._publisher = self._subscription = None
        if self._period <= 0 or not robot.id:
            if hear is not None:
                what = 'no robot is heard: parameter `heartbeat.period` or `member` is missing'
                node.get_logger().warning(what)
            return
        topic = f'{swarm.rstrip("/")}/{_TOPIC}'
        self._publisher = node.create_publisher(String, topic, _SENDING, callback_group=group)
        if hear is not None:
            self._subscription = node.create_subscription(
                String, topic, self._listen, _HEARING, callback_group=group
            )

    def begin(self):
        """Begin with the robots of the start: they are there until they are not heard."""
        if self._publisher is None:
            return
        self.end()
        if self._hear is not None:
            for name in self._first:
                self._note(name)
        self._send()

    def end(self):
        """Send no heartbeats any more, and forget the other robots."""
        for wait in (self._beat, *self._waits.values()):
            if wait is not None:
                self._alarms.unschedule(wait)
        self._beat = None
        self._waits.clear()
        self._heard.clear()

    def release(self):
        """Destroy the publisher and the subscription."""
        self.end()
        if self._publisher is not None:
            self._node.destroy_publisher(self._publisher)
        if self._subscription is not None:
            self._node.destroy_subscription(self._subscription)

    def count(self, role=None):
        """Return how many robots of a role are there, or of all roles, this one included."""
        roles = [self._robot.role, *(Member.called(name).role for name in self._heard)]
        return len(roles) if role is None else roles.count(role)

    def _send(self):
        self._publisher.publish(String(data=self._robot.id))
        self._beat = self._alarms.schedule(self._period, self._send)

    def _listen(self, message):
        self._alarms.post(lambda: self._receive(message.data))

    def _receive(self, name):
        if self._beat is None or not name or not self._counts(name):
            return
        is_new = name not in self._heard
        if self._note(name) and is_new:
            self._hear(Event(JOINED, Member.called(name)))

    def _note(self, name):
        """Note that another robot is heard; return False for this one itself."""
        if name == self._robot.id:
            return False
        self._heard[name] = self._alarms.now
        if name not in self._waits:
            self._watch(name, self._timeout)
        return True

    def _watch(self, name, delay):
        self._waits[name] = self._alarms.schedule(delay, lambda: self._look(name))

    def _look(self, name):
        """Give up a robot that was silent for too long."""
        del self._waits[name]
        left = self._heard[name] + self._timeout - self._alarms.now
        if left > 0:
            self._watch(name, left)
            return
        del self._heard[name]
        self._hear(Event(LOST, Member.called(name)))
