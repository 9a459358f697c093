"""Runs a state machine in a node: the world of the engine, in terms of ROS."""

from collections import deque
import json
from threading import Lock
import traceback
from types import MappingProxyType
from typing import Any, NamedTuple

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import Clock, ClockType
from std_msgs.msg import String

from . import engine, members, models, parameters
from .alarms import Alarms, Pauses
from .diagnostics import Diagnostics, Losses
from .engine import Envelope, Event, ExecutionError, Instance, LoopError, Machine, Servers
from .identity import identity, SETTINGS
from .parameters import Parameter, StartError
from .topics import Delivery, hearing, Topics
from .tracing import Output, Trace
from .values import from_json

# Interfaces on a robot may differ from their descriptions in the model.
engine.FAILURES = (*engine.FAILURES, AttributeError, TypeError)

_SETTINGS = (
    *SETTINGS,
    *members.SETTINGS,
    *models.SETTINGS,
    Parameter('swarm', 'string', '', 'Namespace of the swarm; empty for the one around the own.'),
    Parameter('timeouts.server', 'duration', 5.0, 'How long a server may be missing, in s.'),
    Parameter('timeouts.cancel', 'duration', 5.0, 'How long a server may take to stop, in s.'),
    Parameter('diagnostics.period', 'duration', 1.0, 'Time between diagnostics, in s; 0: none.'),
    Parameter('trace.file', 'string', '', 'Where the trace is written to, as lines of JSON.'),
    Parameter('trace.keep', 'bool', False, 'Whether earlier traces stay, with a number.'),
    Parameter('stay', 'bool', False, 'Whether the node goes on when its machine has ended.'),
    Parameter('debug.inject', 'bool', False, 'Whether events are taken from `~/events`.'),
)


class Behavior(NamedTuple):
    """
    A state machine and the ROS interfaces it uses; `data` creates its variables.

    A machine that `follows_members` hears the heartbeats of other robots. Its trace has the truth
    of the `conditions` that properties name.
    """

    machine: Machine
    data: Any
    parameters: Any = ()
    topics: Any = ()
    functions: Any = MappingProxyType({})
    missing_callbacks: Any = ()
    follows_members: bool = False
    conditions: Any = MappingProxyType({})


def tree(*states):
    """Nest a flat list of states by their ids, which are paths."""
    inside = {}
    for state in reversed(states):
        whole = state._replace(states=tuple(reversed(inside.pop(state.id, []))))
        inside.setdefault(state.id.rpartition('.')[0], []).append(whole)
    return tuple(reversed(inside.get('', [])))


def outcomes(state):
    """Return the event of each outcome of a state's activity."""
    return {each: f'do.{state}.{each}' for each in ('succeeded', 'aborted', 'preempted')}


def by_user(callback, data, message):
    """Call a callback of the user with a message, and return the message."""
    try:
        returned = callback(data, message)
    except (Exception, SystemExit) as error:
        reason = ''.join(traceback.format_exception(error))
        raise ExecutionError(f'callback `{callback.__name__}` failed: {reason}') from error
    return message if returned is None else returned


class Host:
    """
    The machine of a node with its clients, topics and timers.

    Everything that reaches it waits in a queue, so it works with any executor and never blocks.
    Call `configure`, `begin`, `end` and `release` in this order.
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
        self._releases = []
        self._is_configured = self.stays = False
        self.cancel_timeout = self.server_timeout = 0
        parameters.declare(node, (*_SETTINGS, *behavior.parameters))

    # ---- called by nodes

    def configure(self):
        """
        Create all clients and topics; raise StartError if the node cannot start.

        `release` destroys what was created, also after an error.
        """
        node, behavior = self._node, self._behavior
        if behavior.missing_callbacks:
            missing = ', '.join(behavior.missing_callbacks)
            raise StartError(f'the module `callbacks` has no {missing}')
        settings = parameters.values(node, _SETTINGS)
        robot = identity(settings, node.get_namespace())
        self._values = {**parameters.values(node, behavior.parameters), 'self': robot}
        self.server_timeout = settings['timeouts.server']
        self.cancel_timeout = settings['timeouts.cancel']
        self._member = settings['member'] or None
        self._delays = Alarms(node, node.get_clock(), self._group, self.post)
        # Timeouts of servers do not depend on a simulated clock.
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._alarms = Alarms(node, steady, self._group, self.post)
        self._releases += [self._delays.clear, self._alarms.clear]
        self._clients = {}
        for name, function in behavior.functions.items():
            client = self._clients[name] = function.client(node, self._group)
            self._releases.append(client.destroy)
        self._losses = Losses(self, self._tell_lost)
        self._diagnostics = Diagnostics(node, behavior.machine.name, self._member, self._losses)
        self._releases.append(self._diagnostics.release)
        swarm = settings['swarm'] or node.get_namespace().rpartition('/')[0]
        self._topics = Topics(
            node,
            behavior.topics,
            swarm,
            robot,
            self._group,
            lambda: self.now,
            self._receive,
            self._losses.add,
        )
        self._releases.append(self._topics.release)
        self._models = models.Models(
            node, settings, swarm, behavior.machine.name, self._group, self._alarms, self.warn
        )
        self._releases.append(self._models.release)
        self._members = members.Members(
            node,
            settings,
            swarm,
            robot,
            self._group,
            self._delays,
            self._deliver if behavior.follows_members else None,
            self._models.counts,
        )
        self._releases.append(self._members.release)
        self._types = {topic.event: topic.interface for topic in behavior.topics}
        if settings['debug.inject']:
            injected = node.create_subscription(
                String, '~/events', self._inject, hearing(Delivery()), callback_group=self._group
            )
            self._releases.append(lambda: node.destroy_subscription(injected))
        self._servers = Servers()
        self._pauses = Pauses()
        self._period = settings['diagnostics.period']
        path, keep = settings['trace.file'], settings['trace.keep']
        self._output = Output(node, behavior.machine.name, self._member, path, keep)
        self._releases.append(self._output.release)
        self.stays = settings['stay']
        self._is_configured = True
        if self._period > 0:
            self.later(self._period, self._tell_in_intervals)

    def begin(self):
        """Start the machine from its beginning, unless others have another model."""
        self.post(lambda: self._models.admit(self._begin, self._fail))

    def end(self, then=lambda: None):
        """End the machine, and call `then` when no server works for it any more."""
        self.post(lambda: self._end(then))

    def release(self):
        """Destroy everything that `configure` has created."""
        self._is_configured = False
        for call in self._calls.values():
            call.drop()
        self._calls.clear()
        releases, self._releases = self._releases, []
        for release in releases:
            release()

    # ---- used by calls of functions

    @property
    def now(self):
        """Return the time of a steady clock, in nanoseconds."""
        return self._alarms.now

    def later(self, delay, action):
        """Call an action after a delay in nanoseconds of the steady clock."""
        self._alarms.schedule(delay, action)

    def servers(self, function):
        """Return the servers of a function that are in the graph."""
        return function.servers(self._node)

    def subscribe(self, interface, topic, hear, qos):
        """Call a function with each message on a topic, when no other action is running."""
        return self._node.create_subscription(
            interface,
            topic,
            lambda message: self.post(lambda: hear(message)),
            qos,
            callback_group=self._group,
        )

    def unsubscribe(self, subscription):
        """End a subscription."""
        self._node.destroy_subscription(subscription)

    def warn(self, what):
        """Log a problem with which the machine can continue, and add it to the diagnostics."""
        self.logger.warning(what)
        self._diagnostics.warn(what)

    def post(self, action):
        """Run an action now or, if another action is running, after it."""
        self._inbox.append(action)
        while self._inbox and self._turn.acquire(blocking=False):
            try:
                while self._inbox:
                    self._run(self._inbox.popleft())
            finally:
                self._turn.release()

    def forget(self, run):
        """Remove a call that has ended."""
        self._calls.pop(run, None)
        self._look_whether_idle()

    # ---- world of the engine

    @property
    def time(self):
        """Return the time of the node in nanoseconds."""
        return self._delays.now

    def schedule(self, delay, action):
        """Call an action after a delay in the time of the node."""
        return self._delays.schedule(delay, action)

    def unschedule(self, handle):
        """Cancel a delayed call."""
        self._delays.unschedule(handle)

    def start(self, run):
        """Begin an activity, after a pause if its function has just been aborted."""
        function = self._behavior.functions[run.activity.name]
        call = function.call(self, self._clients[run.activity.name], run)
        self._calls[run] = call
        pause = self._pauses.before(run, self.now)
        if pause:
            self.later(pause, call.begin)
        else:
            call.begin()

    def cancel(self, run):
        """Stop an activity."""
        self._calls[run].cancel()

    def send(self, instance, event):
        """Publish an event."""
        self._topics.send(event)

    def present(self, role=None):
        """Return how many robots of a role are there, or of all roles."""
        return self._members.count(role)

    def observer(self):
        """Return the observer of the engine."""
        return self._trace

    def failed(self, instance, error):
        """Log a guard, an effect or a goal that could not be evaluated."""
        self.warn(f'no value: {error}')

    # ---- internal

    def _begin(self):
        data = self._behavior.data(self._values)
        self._trace = Trace(
            self._member,
            lambda: self._delays.now,
            self._behavior.conditions,
            self._output.tell,
        )
        self._instance = Instance(
            self._behavior.machine,
            self,
            data=data,
            observer=self.observer(),
            servers=self._servers,
        )
        self._trace.on_end = lambda event: self._pauses.note(event.origin, event, self.now)
        self._trace.begin(self._instance, None)
        # The first state may count the robots of the start.
        self._members.begin()
        self._instance.start()

    def _not_begun(self):
        """Note that the machine was ended before it began."""

    def _end(self, then):
        if not self._is_configured:
            then()
            return
        if self._models.withdraw():
            self._not_begun()
        if self._instance is not None and self._instance.running:
            self._trace.begin(self._instance, Event('node.shutdown'))
            self._instance.stop()
            self._trace.flush()
        self._members.end()
        self._waiting.append(then)
        self._look_whether_idle()

    def _look_whether_idle(self):
        """Call the waiting functions when all servers have stopped."""
        if not self._calls:
            waiting, self._waiting = self._waiting, []
            for then in waiting:
                then()

    def _run(self, action):
        """Run an action; an exception in it ends the machine, not the node."""
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
        """Stop the machine and cancel its calls."""
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
        if self._models.refuses(event.envelope.sender):
            return
        if self._instance is not None and self._instance.running:
            self._trace.begin(self._instance, event)
            self._instance.receive(event)

    def _tell_lost(self, counts):
        if self._instance is not None and self._instance.running:
            self._trace.begin(self._instance, Event('node.lost', counts))

    def _inject(self, message):
        """Process an event in the format of `swarmc simulate --events`: a line of JSON."""
        try:
            line = json.loads(message.data)
            name, fields = line['event'], line.get('data', {})
            envelope = Envelope(str(line.get('sender', '')))
            event = Event(name, from_json(self._types[name](), fields), envelope=envelope)
        except (AttributeError, ExecutionError, KeyError, TypeError, ValueError) as error:
            self.logger.warning(f'no event: {message.data} ({error!r})')
            return
        self._receive(event)
