"""States of a machine, each active until its chart has left it."""

import threading
import traceback
from collections import deque

import genpy
import rospy
import smach

from . import engine
from .topics import Event

# Trigger of a transition without a trigger.
AT_ONCE = ''
_SAME = object()
_OUTCOMES = ('succeeded', 'aborted', 'preempted')


class On:
    """A transition of a state; transitions are tried in order.

    `trigger` is an Event, an outcome of the activity, the name of a delay in `after`, AT_ONCE, or
    an event that the machine itself raises: `final.Mission.Found` when that final state is
    entered, `done.state.Mission` when a state is complete. The state ends with `outcome`, which
    the container binds to the target; by default it has the name of the trigger, and with None the
    state stays. `into` is the path of the state that is entered inside the target, if it is not
    the initial state. `guard(userdata, event)` and `effect(userdata, event)` get the message of the
    event, and with a third parameter `envelope` its sender and its time. An `internal` transition
    does not leave the state; the state inside ends with `outcome`.
    """

    def __init__(self, trigger, outcome=_SAME, guard=None, effect=None, into='', internal=False):
        self.trigger = trigger
        self.outcome = getattr(trigger, 'name', trigger) if outcome is _SAME else outcome
        self.guard = guard
        self.effect = effect
        self.into = into
        self.internal = internal


class Charted:
    """Base class of the states and containers of a machine.

    `after` has the delays of transitions by name, as functions of userdata; `on_entry(userdata)`
    and `on_exit(userdata)` are effects; the events of `defer` are kept until a state that does not
    defer them.
    """

    kind = engine.Kind.STATE
    container = None
    chart = None
    label = ''
    path = ''

    def describe(self, on, after, on_entry, on_exit, defer):
        """Store the data for the chart; return the outcomes of the transitions."""
        self.on = on
        self.after = after or {}
        self.on_entry = on_entry
        self.on_exit = on_exit
        self.defer = defer
        self.current = None
        self.following = None
        self._activations = deque()
        outcomes = (each.outcome for each in on if each.outcome and not each.internal)
        return list(dict.fromkeys(outcomes))

    def place(self, label, container, chart):
        """Set the place of the state in the machine."""
        self.label = label
        self.container = container
        self.chart = chart
        self.path = joined(container.path, label)

    def add_activation(self, activation):
        """Note that the state has been entered."""
        self.current = activation
        self._activations.append(activation)
        if self.container is not None:
            self.container.current.entered.append(self.label)

    def end(self):
        """Note that the state has been left."""
        if self.current is not None:
            self.current.is_over = True

    def follow(self):
        """Return the next activation for SMACH."""
        with self.chart.changed:
            self.following = self._activations.popleft()
            if self.container is not None:
                self.container.following.entered.popleft()
            return self.following

    def wait(self, activation):
        """Wait until the state is left."""
        with self.chart.changed:
            self.chart.changed.wait_for(lambda: activation.is_over)

    # ---- called by the chart

    def heard(self):
        """Return the events that trigger transitions of the state, or that it defers."""
        return [*(on.trigger for on in self.on if isinstance(on.trigger, Event)), *self.defer]

    def tables(self):
        """Return the tables of the states inside for the engine."""
        return ()

    def table(self):
        """Return the table of the state for the engine."""
        entry = [_effect(self.on_entry)] if self.on_entry else []
        leave = [_effect(self.on_exit)] if self.on_exit else []
        for name, delay in self.after.items():
            entry.append(_start(self._event(name), delay))
            leave.insert(0, _cancel(self._event(name)))
        return engine.State(
            self.path,
            self.kind,
            tuple(self.tables()),
            self.initial_path(),
            tuple(map(self._transition, self.on)),
            tuple(entry),
            tuple(leave),
            origin=self,
            deferred=tuple(event.name for event in self.defer),
            timed=True,
        )

    def initial_path(self):
        """Return the path of the initial state."""
        return ()

    def _transition(self, on):
        return engine.Transition(
            (self._event(on.trigger),) if on.trigger is not AT_ONCE else (),
            (self._target(on),) if on.outcome else (),
            _guard(on.guard) if on.guard else None,
            _with_event(on.effect) if on.effect else None,
            on.internal,
            (self, on),
        )

    def _event(self, trigger):
        if isinstance(trigger, Event):
            return trigger.name
        if trigger in self.after:
            return joined('after', self.path, trigger)
        return joined('do', self.path, trigger) if trigger in _OUTCOMES else trigger

    def _target(self, on):
        """Return the path of the state that SMACH reaches with the outcome of a transition."""
        if on.internal:
            container = self
            to = next(to for (_, outcome), to in self.edges.items() if outcome == on.outcome)
        else:
            container = self.container
            to = container.edges[self.label, on.outcome]
        while to not in container.get_children() and container.container is not None:
            to = container.container.edges[container.label, to]
            container = container.container
        return joined(container.path, to, on.into)


class State(Charted, smach.State):
    """A state without an activity.

    `outcomes` are outcomes of internal transitions of the states around.
    """

    def __init__(self, on=(), outcomes=(), after=None, on_entry=None, on_exit=None, defer=()):
        own = self.describe(on, after, on_entry, on_exit, defer)
        smach.State.__init__(self, [*own, *outcomes, 'preempted'])

    def execute(self, userdata):
        """Wait until the chart has left the state; return the outcome."""
        activation = self.follow()
        self.perform(activation)
        self.wait(activation)
        return activation.outcome or 'preempted'

    def perform(self, activation):
        """Perform the activity of the state."""


class Final(State):
    """A final state, in which the state around is complete."""

    kind = engine.Kind.FINAL

    def table(self):
        """Return the table, with an entry action that raises the event of the final state."""
        done = engine.Event(joined('final', self.path))
        table = super().table()
        return table._replace(entry=(lambda instance, event: instance.raise_event(done),))


class History(State):
    """Leads to the last active state of the container, at first to `default`.

    `outcomes` are the labels of these states; `deep` restores the states inside as well.
    """

    def __init__(self, default, outcomes, deep=False):
        super().__init__(outcomes=outcomes)
        self.kind = engine.Kind.DEEP_HISTORY if deep else engine.Kind.HISTORY
        self._default = default

    def table(self):
        """Return the table, with one transition to the default."""
        default = engine.Transition(targets=(joined(self.container.path, self._default),))
        return engine.State(self.path, self.kind, transitions=(default,))

    def execute(self, userdata):
        """Return the label of the state that the chart has entered."""
        return self.container.next_label()


class Activity(State):
    """A state that calls a server while it is active.

    `name` is the name of the server; `store(userdata, result)` stores the result of a success in
    userdata.
    """

    def __init__(self, name, store=None, **keywords):
        super().__init__(**keywords)
        self.name = name
        self._store = store
        self._wake = threading.Event()

    def table(self):
        """Return the table, with the server and the events of its outcomes."""
        events = {outcome: self._event(outcome) for outcome in _OUTCOMES}
        if 'preempted' not in [each.trigger for each in self.on]:
            events['preempted'] = events['aborted']
        store = _with_event(self._store) if self._store else None
        activity = engine.Activity(self.name, self.name, events, finalize=store)
        return super().table()._replace(activity=activity)

    def request_preempt(self):
        """End the call."""
        super().request_preempt()
        self._wake.set()

    def perform(self, activation):
        """Call the server, unless the state has been left already."""
        with self.chart.changed:
            # Wait for a server that is still stopping for another state.
            self.chart.changed.wait_for(lambda: activation.run or activation.is_over)
            if activation.is_over:
                return
            activation.is_called = True
            self.recall_preempt()
            self._wake.clear()
        pause = self.chart.pauses.before(self.name)
        if pause:
            self._wake.wait(pause)
        try:
            outcome, result = ('preempted', None) if self.preempt_requested() else self.call()
            if outcome not in _OUTCOMES:
                raise ValueError('a callback returned {!r}, which is no outcome'.format(outcome))
        except Exception:
            outcome, result = 'aborted', None
            rospy.logerr('%s in state %s:\n%s', self.name, self.path, traceback.format_exc())
        self.chart.pauses.note(self.name, outcome)
        self.chart.ended(activation, outcome, result)

    def call(self):
        """Call the server; return the outcome and the result."""
        raise NotImplementedError

    def ask(self, callback, *arguments):
        """Call a callback while the machine is locked; return its result."""
        with self.chart.changed:
            if callback is not None and not self.preempt_requested():
                Event.machine = self.current.run.instance
                return callback(self.container.userdata, *arguments)
        return None


def is_active(path):
    """Return True while a state of the machine is active; for its guards, effects and callbacks."""
    return Event.machine.active(path)


def elapsed(path):
    """Return for how long an active state has been active, as a duration; for the same."""
    return rospy.Duration(0, Event.machine.elapsed(path))


def message(message_type, fields):
    """Return a message with values in its fields."""
    made = message_type()
    genpy.message.fill_message_args(made, [fields])
    return made


class StartError(Exception):
    """The configuration does not allow the machine to start."""


def param(name, kind, *default):
    """Return the value of a ROS parameter; `kind` is its type, or a list with the type of elements.

    Raises StartError for a value of another type; integers are valid floats.
    """
    value = rospy.get_param(name, *default)
    if not _is(value, kind):
        wanted = 'list of {}'.format(kind[0].__name__) if isinstance(kind, list) else kind.__name__
        text = 'param {} is {!r}, which is no {}'
        raise StartError(text.format(rospy.resolve_name(name), value, wanted))
    return value


def require(callbacks, signatures):
    """Raise StartError if the user's module lacks callbacks of the model."""
    missing = [text for text in signatures if not hasattr(callbacks, text.partition('(')[0])]
    if missing:
        raise StartError('callbacks.py lacks {}'.format(', '.join(missing)))


def joined(*parts):
    """Return a path of the parts that are not empty."""
    return '.'.join(filter(None, parts))


def _is(value, kind):
    if isinstance(kind, list):
        return isinstance(value, list) and all(_is(each, kind[0]) for each in value)
    return type(value) in ((float, int) if kind is float else (kind,))


def _guard(function):
    """Return a guard for the engine; a guard that raises an exception is false."""

    def call(instance, event):
        try:
            return _call(function, instance, event)
        except Exception as error:
            rospy.logerr('a guard has no value: %r', error)
            return False

    return call


def _effect(function):
    return _with_event(lambda userdata, event: function(userdata), function)


def _with_event(function, named=None):
    """Return a function for the engine, with exceptions as ExecutionError."""

    def call(instance, event):
        try:
            return _call(function, instance, event)
        except Exception as error:
            name = (named or function).__name__
            raise engine.ExecutionError('{} failed: {!r}'.format(name, error)) from error

    return call


def _call(function, instance, event):
    """Call a function of a model with the message of an event, and its envelope if it asks."""
    Event.machine = instance
    if function.__code__.co_argcount > 2:
        return function(instance.data, event.data, event.envelope)
    return function(instance.data, event.data)


def _start(name, delay):
    def start(userdata, event):
        return delay(userdata).to_nsec()

    length = _with_event(start, delay)
    return lambda instance, event: instance.send_after(
        engine.Event(name), length(instance, event), name
    )


def _cancel(name):
    return lambda instance, event: instance.cancel(name)
