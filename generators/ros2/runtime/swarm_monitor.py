"""Node that watches the properties of a swarm on its robots, and measures its fitness."""

import re
from typing import Any, NamedTuple

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

from . import parameters
from .alarms import Alarms
from .parameters import Parameter, StartError
from .property_monitors import FALSE
from .robot_lines import check_robot, RobotLines
from .swarm_verdicts import Verdicts
from .swarm_watch import Watches
from .tracing import HISTORY
from .values import MILLISECOND, SECOND

_SETTINGS = (
    Parameter('swarm', 'string', '', 'Namespace of the swarm; empty for that of the node.'),
    Parameter('members', 'string', '', 'Robots that are to be heard, divided by spaces.'),
    Parameter('wait', 'duration', 1.0, 'How long a line of a robot may be on its way, in s.'),
    Parameter('wait.start', 'duration', 10.0, 'How long `members` are waited for, in s.'),
    Parameter('diagnostics.period', 'duration', 1.0, 'Time between diagnostics, in s; 0: none.'),
    Parameter('trace.file', 'string', '', 'Where lines of robots and verdicts are written to.'),
)
_QOS = QoSProfile(depth=HISTORY, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_LOOK = SECOND // 2
"""Time between looks for robots, in nanoseconds."""


class Swarm(NamedTuple):
    """
    Swarm to watch: the machines of its roles and parts, its properties, and its fitness.

    The `measures` are inputs of the fitness.
    """

    name: str
    machines: Any
    properties: Any
    fitness: str = ''
    measures: Any = ()


class MonitorNode(Node):
    """Watches a swarm until a signal comes."""

    def __init__(self, swarm, name, on_end):
        super().__init__(name)
        self.failed = False
        self.host = None
        self._swarm = swarm

    def prepare(self):
        """Begin to watch; raise StartError if the parameters do not allow it."""
        self.host = Monitor(self, self._swarm)


class Monitor:
    """Hears the lines of all robots, judges them in the order of time, and tells verdicts."""

    cancel_timeout = 0

    def __init__(self, node, swarm):
        self._node = node
        parameters.declare(node, _SETTINGS)
        settings = parameters.values(node, _SETTINGS)
        self._around = (settings['swarm'] or node.get_namespace()).rstrip('/')
        self._group = ReentrantCallbackGroup()
        self._alarms = Alarms(node, node.get_clock(), self._group, _run)
        # Looks for robots do not depend on a simulated clock.
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._looks = Alarms(node, steady, self._group, _run)
        self._wake = None
        expected = settings['members'].split()
        _check(expected, swarm.machines)
        wait, start = (settings[each] // MILLISECOND for each in ('wait', 'wait.start'))
        self._lines = RobotLines(swarm.machines, expected, wait, start)
        self._verdicts = Verdicts(node, swarm, self._lines, settings['trace.file'])
        self._news = {}
        self._watch = Watches(swarm, self._note)
        self._subscriptions = {}
        self._period = settings['diagnostics.period']
        for topic in topics(self._around, swarm.machines, expected):
            self._subscribe(topic)
        self._look_for_robots()
        if self._period > 0:
            self._tell_in_intervals()

    # ---- called by the process

    def end(self, then):
        """Judge all lines that were heard, tell the verdicts, and call `then`."""
        for line in self._lines.rest():
            self._see(line)
        if self._lines.zero is not None:
            time = self._settle()
            readings = self._watch.last_readings(time)
            self._verdicts.finish(self._watch.results(time), readings, time)
        then()

    def release(self):
        """Destroy everything that was created."""
        self._alarms.clear()
        self._looks.clear()
        for heard in self._subscriptions.values():
            self._node.destroy_subscription(heard.subscription)
        self._verdicts.release()

    # ---- lines

    def _subscribe(self, topic):
        names = set()
        subscription = self._node.create_subscription(
            String,
            topic,
            lambda message: self._hear(message.data, names),
            _QOS,
            callback_group=self._group,
        )
        self._subscriptions[topic] = _Heard(subscription, names)

    def _hear(self, text, names):
        name = self._lines.hear(text, self._now)
        if name is not None:
            names.add(name)
        self._go_on()

    def _go_on(self):
        """Judge the lines that have waited long enough, and the time that has passed."""
        for line in self._lines.ready(self._now):
            self._see(line)
        if self._lines.zero is not None:
            self._settle()
        if self._wake is not None:
            self._alarms.unschedule(self._wake)
        then = self._lines.next_look(self._watch.due)
        if then is not None:
            delay = max(then * MILLISECOND - self._alarms.now, 0)
            self._wake = self._alarms.schedule(delay, self._go_on)

    def _see(self, line):
        """Process a line of a robot, in the order of time."""
        self._verdicts.record(line)
        self._watch.see(line)
        self._tell_news()

    def _settle(self):
        """Let time pass as far as no earlier line is expected; return it."""
        time = self._lines.since_zero(self._lines.settled(self._now))
        self._watch.advance(time)
        self._tell_news()
        return time

    @property
    def _now(self):
        """Return the time of the node in milliseconds."""
        return self._alarms.now // MILLISECOND

    # ---- verdicts

    def _note(self, property_, verdict, time):
        self._news[property_.name] = property_, verdict, time

    def _tell_news(self):
        """Tell verdicts that have changed, and violations."""
        new = list(self._watch.new_violations())
        for violation in new:
            self._verdicts.violated(violation)
            self._note(violation.property, FALSE, violation.time)
        news, self._news = self._news, {}
        for each in news.values():
            self._verdicts.note(*each)
        if new:
            self._verdicts.tell()

    def _tell_in_intervals(self):
        if self._lines.zero is not None:
            time = self._settle()
            self._verdicts.measure(self._watch.readings(time), time)
        self._verdicts.tell()
        self._looks.schedule(self._period, self._tell_in_intervals)

    # ---- robots

    def _look_for_robots(self):
        """Listen to new nodes, and note those that are gone."""
        pattern = re.compile(rf'{re.escape(self._around)}/[^/]+/[^/]+/transitions')
        for topic, _ in self._node.get_topic_names_and_types():
            if pattern.fullmatch(topic) and topic not in self._subscriptions:
                self._subscribe(topic)
        for topic, heard in self._subscriptions.items():
            if heard.names and not self._node.count_publishers(topic):
                for name in heard.names:
                    self._lines.lose(name, self._now)
                self._go_on()
        self._looks.schedule(_LOOK, self._look_for_robots)


class _Heard(NamedTuple):
    """Subscription to the lines of a node, with the names of its machines."""

    subscription: Any
    names: Any


def topics(around, machines, robots):
    """Yield the topics of the nodes of robots, in the namespace of the swarm."""
    for robot in robots:
        role, _, number = robot.partition('[')
        for who, machine in machines.items():
            if who.partition('.')[0] == role:
                yield f'{around}/{role}_{number.rstrip("]")}/{machine.node}/transitions'


def _check(robots, machines):
    """Raise StartError if one of the robots that are to be heard is not in the swarm."""
    for each in robots:
        try:
            check_robot(each, machines)
        except KeyError as error:
            raise StartError(f'parameter `members`: {error.args[0]}') from None


def _run(action):
    action()
