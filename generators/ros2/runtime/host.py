"""Runs a state machine in a node: what the engine asks of the world around it is here."""

from collections import deque
import json
from threading import Lock
import traceback
from types import MappingProxyType
from typing import Any, NamedTuple

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import Clock, ClockType
from rclpy.logging import LoggingSeverity
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

from . import engine, parameters
from .alarms import Alarms
from .diagnostics import Diagnostics
from .engine import Event, ExecutionError, Instance, LoopError, Machine, Servers
from .parameters import Parameter, StartError
from .topics import Topics
from .tracing import as_json, Trace
from .values import from_json

# What a robot knows of an interface may differ from what the model says of it.
engine.FAILURES = (*engine.FAILURES, AttributeError, TypeError)

_SETTINGS = (
    Parameter('member', 'string', '', 'Who this is, in traces: `uav[0]`.'),
    Parameter('swarm', 'string', '', 'Namespace of the swarm; empty for the one around the own.'),
    Parameter('timeouts.server', 'duration', 5.0, 'How long a server may be missing, in s.'),
    Parameter('timeouts.cancel', 'duration', 5.0, 'How long a server may take to stop, in s.'),
    Parameter('diagnostics.period', 'duration', 1.0, 'Time between diagnostics, in s; 0: none.'),
    Parameter('trace.file', 'string', '', 'Where the trace is written to, as lines of JSON.'),
    Parameter('debug.inject', 'bool', False, 'Whether events are taken from `~/events`.'),
)
_LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_DEPTH = 100
_HISTORY = QoSProfile(depth=_DEPTH, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Behavior(NamedTuple):
    """A state machine of the model, and what of ROS it uses; `data` makes what it remembers."""

    machine: Machine
    data: Any
    parameters: Any = ()
    topics: Any = ()
    functions: Any = MappingProxyType({})
    missing_callbacks: Any = ()


def tree(*states):
    """Put states into each other: their ids are paths."""
    inside = {}
    for state in reversed(states):
        whole = state._replace(states=tuple(reversed(inside.pop(state.id, []))))
        inside.setdefault(state.id.rpartition('.')[0], []).append(whole)
    return tuple(reversed(inside.get('', [])))


def outcomes(state):
    """Return the events of how the activity of a state can end."""
    return {each: f'do.{state}.{each}' for each in ('succeeded', 'aborted', 'preempted')}


def by_user(callback, data, message):
    """Let a callback of the user fill a message or read one, and return the message."""
    try:
        returned = callback(data, message)
    except Exception as error:
        reason = ''.join(traceback.format_exception(error))
        raise ExecutionError(f'callback `{callback.__name__}` failed: {reason}') from error
    return message if returned is None else returned


class Host:
    """
    The machine of a node with its clients, topics and timers.

    Whatever reaches it waits for its turn in a queue, so that any executor will do and nothing
    blocks: `configure`, `begin`, `end` and `release` it in this order.
    """

    def __init__(self, node, behavior, on_end=lambda failed: None):
        self._node = node
        self._behavior = behavior
        self._on_end = on_end
        self.logger = node.get_logger()
        self._group = ReentrantCallbackGroup()
        self._inbox = deque()
        self._turn = Lock()
        self._calls = {}
        self._instance = None
        self._waiting = []
        self._file = None
        self._is_configured = False
        self.cancel_timeout = self.server_timeout = 0
        parameters.declare(node, (*_SETTINGS, *behavior.parameters))

    # ---- what a node calls

    def configure(self):
        """Make all clients and topics; raise StartError where the node is not fit for it."""
        node, behavior = self._node, self._behavior
        if behavior.missing_callbacks:
            missing = ', '.join(behavior.missing_callbacks)
            raise StartError(f'the module `callbacks` has no {missing}')
        self._values = parameters.values(node, behavior.parameters)
        settings = parameters.values(node, _SETTINGS)
        self.server_timeout = settings['timeouts.server']
        self.cancel_timeout = settings['timeouts.cancel']
        self._member = settings['member'] or None
        self._delays = Alarms(node, node.get_clock(), self._group, self.post)
        # Servers do not wait for a simulated clock.
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._alarms = Alarms(node, steady, self._group, self.post)
        self._state = node.create_publisher(String, '~/state', _LATCHED)
        self._transitions = node.create_publisher(String, '~/transitions', _HISTORY)
        self._clients = {
            name: function.client(node, self._group)
            for name, function in behavior.functions.items()
        }
        swarm = settings['swarm'] or node.get_namespace().rpartition('/')[0]
        self._topics = Topics(
            node,
            behavior.topics,
            swarm,
            settings['member'],
            self._group,
            lambda: self.now,
            self._receive,
        )
        self._types = {topic.event: topic.interface for topic in behavior.topics}
        self._injected = None
        if settings['debug.inject']:
            self._injected = node.create_subscription(
                String, '~/events', self._inject, _DEPTH, callback_group=self._group
            )
        self._servers = Servers()
        self._period = settings['diagnostics.period']
        self._diagnostics = Diagnostics(node, behavior.machine.name, self._member)
        if settings['trace.file']:
            try:
                self._file = open(settings['trace.file'], 'w', encoding='utf-8')
            except OSError as error:
                raise StartError(f'the trace cannot be written: {error}') from None
        self._is_configured = True
        if self._period > 0:
            self.later(self._period, self._tell_in_intervals)

    def begin(self):
        """Start the machine from its beginning."""
        self.post(self._begin)

    def end(self, then=lambda: None):
        """End the machine, and call `then` when no server works for it any more."""
        self.post(lambda: self._end(then))

    def release(self):
        """Give back what `configure` has made, if it has."""
        if not self._is_configured:
            return
        self._is_configured = False
        for call in self._calls.values():
            call.drop()
        self._calls.clear()
        self._delays.clear()
        self._alarms.clear()
        for client in self._clients.values():
            client.destroy()
        self._topics.release()
        if self._injected is not None:
            self._node.destroy_subscription(self._injected)
        self._diagnostics.release()
        self._node.destroy_publisher(self._state)
        self._node.destroy_publisher(self._transitions)
        if self._file is not None:
            self._file.close()
            self._file = None

    # ---- what calls of functions use

    @property
    def now(self):
        """The nanoseconds of a clock that runs steadily."""
        return self._alarms.now

    def later(self, delay, action):
        """Call an action in so many nanoseconds of that clock."""
        self._alarms.schedule(delay, action)

    def warn(self, what):
        """Say what has gone wrong while the machine goes on."""
        self.logger.warning(what)
        self._diagnostics.warn(what)

    def post(self, action):
        """Run an action now or, where another one is in the middle of something, after it."""
        self._inbox.append(action)
        while self._inbox and self._turn.acquire(blocking=False):
            try:
                while self._inbox:
                    self._run(self._inbox.popleft())
            finally:
                self._turn.release()

    def forget(self, run):
        """Take note that a call is over."""
        self._calls.pop(run, None)
        self._look_whether_idle()

    # ---- what the engine asks of the world

    def schedule(self, delay, action):
        """Call something later, in the time of the node."""
        return self._delays.schedule(delay, action)

    def unschedule(self, handle):
        """Do not call it."""
        self._delays.unschedule(handle)

    def start(self, run):
        """Begin an activity."""
        function = self._behavior.functions[run.activity.name]
        call = function.call(self, self._clients[run.activity.name], run)
        self._calls[run] = call
        call.begin()

    def cancel(self, run):
        """Stop an activity."""
        self._calls[run].cancel()

    def send(self, instance, event):
        """Publish an event."""
        self._topics.send(event)

    def observer(self):
        """Return who is told what the engine does."""
        return self._trace

    def failed(self, instance, error):
        """Say that a guard, an effect or a goal has no value."""
        self.warn(f'no value: {error}')

    # ---- inside

    def _begin(self):
        data = self._behavior.data(self._values)
        zero = self._delays.now
        self._trace = Trace(self._member, lambda: self._delays.now - zero, self._tell)
        self._instance = Instance(
            self._behavior.machine,
            self,
            data=data,
            observer=self.observer(),
            servers=self._servers,
        )
        self._trace.begin(self._instance, None)
        self._instance.start()

    def _end(self, then):
        if self._instance is not None and self._instance.running:
            self._trace.begin(self._instance, Event('node.shutdown'))
            self._instance.stop()
            self._trace.flush()
        self._waiting.append(then)
        self._look_whether_idle()

    def _look_whether_idle(self):
        """Tell all who have ended the machine that all servers have stopped."""
        if not self._calls:
            waiting, self._waiting = self._waiting, []
            for then in waiting:
                then()

    def _run(self, action):
        """Run an action to its end; whatever goes wrong in it ends the machine, not the node."""
        was_running = self._instance is not None and self._instance.running
        try:
            action()
        except LoopError as error:
            self._fail(str(error))
        except Exception:
            self._fail(traceback.format_exc())
        if self._instance is None:
            return
        self._trace.flush()
        if self._instance.final is not None and was_running and not self._instance.running:
            self.logger.info(f'the machine has ended in {self._instance.final}')
            self._on_end(False)

    def _fail(self, what):
        """Stop what is going on, as far as that is still possible."""
        self.logger.fatal(what)
        if self._instance is not None:
            self._instance.running = False
        self._diagnostics.fail(what)
        self._tell_how_it_is()
        for call in list(self._calls.values()):
            call.cancel()
        self._on_end(True)

    def _tell_in_intervals(self):
        self._tell_how_it_is()
        self.later(self._period, self._tell_in_intervals)

    def _tell_how_it_is(self):
        instance = self._instance
        if self._period > 0 and instance is not None:
            states = [instance.final] if instance.final else instance.configuration.innermost
            self._diagnostics.tell(states, instance.running, list(self._calls.values()))

    def _receive(self, event):
        self.post(lambda: self._deliver(event))

    def _deliver(self, event):
        if self._instance is not None and self._instance.running:
            self._trace.begin(self._instance, event)
            self._instance.receive(event)

    def _inject(self, message):
        """Take an event as `swarmc simulate --events` has it: a line of JSON."""
        try:
            line = json.loads(message.data)
            name, fields = line['event'], line.get('data', {})
            event = Event(name, from_json(self._types[name](), fields))
        except (AttributeError, ExecutionError, KeyError, TypeError, ValueError) as error:
            self.logger.warning(f'no event: {message.data} ({error!r})')
            return
        self._receive(event)

    def _tell(self, line, taken):
        """Say what an event led to: on the topics, in the log, and in the file."""
        text = as_json(line)
        self._transitions.publish(String(data=text))
        if self._file is not None:
            self._file.write(text + '\n')
            self._file.flush()
        if line['entered'] or line['exited'] or line['event'] is None:
            state = {
                'machine': self._behavior.machine.name,
                'member': self._member,
                'configuration': line['configuration'],
                'final': self._instance.final,
            }
            self._state.publish(String(data=as_json(state)))
        places = ', '.join(each.origin for each in taken if each.origin)
        where = ', '.join(line['configuration'])
        what = line['event'] or 'start'
        # Not `info`: rclpy looks who has called, frame by frame, longer than all of this takes.
        said = f'{what} -> {where} ({places})' if places else f'{what} -> {where}'
        self.logger.log(said, LoggingSeverity.INFO)
