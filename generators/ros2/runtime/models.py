"""The model of this node, told to the swarm, and nodes of the swarm with another model."""

import json
from typing import Any, NamedTuple

from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

from . import model
from .parameters import Parameter, StartError

WARN, REFUSE, IGNORE = 'warn', 'refuse', 'ignore'
_MODES = (WARN, REFUSE, IGNORE)
SETTINGS = (
    Parameter('model.others', 'string', WARN, 'Robots of another model: warn, refuse or ignore.'),
    Parameter('model.wait', 'duration', 2.0, 'With `refuse`, time before the start, in s.'),
)
_TOPIC = 'models'
_DEPTH = 1000


class Told(NamedTuple):
    """A node with its model, as it tells them."""

    node: str
    member: str
    machine: str
    model: str
    version: str
    digest: str

    @classmethod
    def read(cls, text):
        """Return what a message tells; raise ValueError if it is something else."""
        data = json.loads(text)
        if not isinstance(data, dict):
            raise ValueError('not an object')
        return cls(*(str(data.get(name, '')) for name in cls._fields))

    @property
    def robot(self):
        """Return the robot of the node, or the node itself if it has not told one."""
        return self.member.partition('.')[0] or self.node

    def __str__(self):
        """Return the node with its model."""
        return f'{self.robot} has {self.model} {self.version} ({self.digest})'


class Models:
    """
    Tells the model of the node, also to those that come later, and hears those of others.

    A node that refuses others begins no machine among them. If they come later, it neither counts
    their robots nor hears their events. `warn` is called with a text for each of them.
    """

    def __init__(self, node, settings, swarm, machine, group, alarms, warn):
        self._node = node
        self._alarms = alarms
        self._warn = warn
        self._mode = settings['model.others']
        if self._mode not in _MODES:
            said = ', '.join(f'`{mode}`' for mode in _MODES)
            raise StartError(f'parameter `model.others` is `{self._mode}`, but can be {said}')
        self._wait = settings['model.wait'] if self._mode == REFUSE else 0
        self._told = {}
        self._start: Any = None
        self._own = Told(
            node.get_fully_qualified_name(),
            settings['member'],
            machine,
            model.NAME,
            model.VERSION,
            model.DIGEST,
        )
        topic = f'{swarm.rstrip("/")}/{_TOPIC}'
        last = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self._publisher = node.create_publisher(String, topic, last, callback_group=group)
        self._publisher.publish(String(data=json.dumps(self._own._asdict(), ensure_ascii=False)))
        self._subscription = None
        if self._mode != IGNORE:
            all_ = QoSProfile(depth=_DEPTH, durability=DurabilityPolicy.TRANSIENT_LOCAL)
            self._subscription = node.create_subscription(
                String, topic, self._listen, all_, callback_group=group
            )

    def admit(self, begin, refuse):
        """Call `begin`, or `refuse` with a text if there are nodes of another model."""
        if self._mode != REFUSE:
            begin()
            return
        self._start = self._alarms.schedule(self._wait, lambda: self._decide(begin, refuse))

    def withdraw(self):
        """Call neither `begin` nor `refuse` any more; return True if the node waited for it."""
        was_waiting, start, self._start = self._start is not None, self._start, None
        if start is not None:
            self._alarms.unschedule(start)
        return was_waiting

    def refuses(self, robot):
        """Return True for a robot with another model, if such robots are refused."""
        return self._mode == REFUSE and any(each.robot == robot for each in self._others())

    def counts(self, robot):
        """Return True for a robot that is not refused, and has told its model."""
        if self._mode != REFUSE:
            return True
        told = any(each.robot == robot for each in self._told.values())
        return told and not self.refuses(robot)

    def release(self):
        """Destroy the publisher and the subscription."""
        self.withdraw()
        self._node.destroy_publisher(self._publisher)
        if self._subscription is not None:
            self._node.destroy_subscription(self._subscription)

    def _decide(self, begin, refuse):
        self._start = None
        others = self._others()
        if others:
            said = '; '.join(map(str, others))
            refuse(f'refused to begin with {_described(self._own)}: {said}')
        else:
            begin()

    def _listen(self, message):
        self._alarms.post(lambda: self._hear(message.data))

    def _hear(self, text):
        try:
            told = Told.read(text)
        except ValueError:
            self._warn(f'no model is told by `{text}` on topic {_TOPIC}')
            return
        is_new = self._told.get(told.node) != told
        self._told[told.node] = told
        if is_new and told.digest != self._own.digest:
            refused = ' and is refused' if self._mode == REFUSE else ''
            self._warn(f'another model: {told}, not {_described(self._own)}{refused}')

    def _others(self):
        """Return what nodes of another model have told."""
        return [each for each in self._told.values() if each.digest != self._own.digest]


def _described(told):
    return f'{told.model} {told.version} ({told.digest})'
