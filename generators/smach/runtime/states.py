"""States of a machine, each of which is active until its chart says that it is left."""

import threading
import traceback
from collections import deque

import genpy
import rospy
import smach

from . import engine

# The trigger of a transition that waits for nothing.
AT_ONCE = ''
_SAME = object()
_OUTCOMES = ('succeeded', 'aborted', 'preempted')


class Event:
    """Something that happens, known by a message on a topic."""

    def __init__(self, name, message_type, heard_on, sent_on):
        self.name = name
        self.message_type = message_type
        self.heard_on = heard_on
        self.sent_on = sent_on
        self._publisher = None

    def listen(self, receive):
        """Call `receive(name, message)` with each message from now on."""
        rospy.Subscriber(self.heard_on, self.message_type, lambda m: receive(self.name, m))

    def advertise(self):
        """Make ready to send, once."""
        if self._publisher is None:
            self._publisher = rospy.Publisher(self.sent_on, self.message_type, queue_size=10)

    def send(self, message):
        """Publish a message, its header stamped and its swarmros header named."""
        fields = message.__slots__
        if 'header' in fields and hasattr(message.header, 'stamp') and not message.header.stamp:
            message.header.stamp = rospy.Time.now()
        if 'swarmio' in fields and not message.swarmio.name:
            message.swarmio.name = self.sent_on
        try:
            self._publisher.publish(message)
        except rospy.ROSException:
            if not rospy.is_shutdown():  # nobody hears what is sent on the way out
                raise


class On:
    """A transition of a state, tried in the order in which they are given.

    `trigger` is an Event, an outcome of the activity, a delay by its name in `after`, AT_ONCE, or
    an event that the machine itself raises: `final.Mission.Found` when that final state is
    entered, `done.state.Mission` when a state is done. `outcome` is what the state ends with, which
    the container binds to a state; it is called like the trigger where it is not given, and with
    None the state stays. `into` is the state inside of that one that is entered, where it is not
    the initial one. `guard(userdata, event)` and `effect(userdata, event)` get the message of the
    event. An `internal` transition does not leave the state; the one inside ends with `outcome`.
    """

    def __init__(self, trigger, outcome=_SAME, guard=None, effect=None, into='', internal=False):
        self.trigger = trigger
        self.outcome = getattr(trigger, 'name', trigger) if outcome is _SAME else outcome
        self.guard = guard
        self.effect = effect
        self.into = into
        self.internal = internal


class Charted:
    """What the states and the containers of a machine have in common.

    `after` has the delays that are waited for while the state is active, functions of userdata,
    by name; `on_entry(userdata)` and `on_exit(userdata)` are its effects.
    """

    kind = engine.Kind.STATE
    container = None
    chart = None
    label = ''
    path = ''

    def describe(self, on, after, on_entry, on_exit):
        """Keep what the chart needs; return the outcomes of the transitions."""
        self.on = on
        self.after = after or {}
        self.on_entry = on_entry
        self.on_exit = on_exit
        self.current = None
        self.following = None
        self._activations = deque()
        outcomes = (each.outcome for each in on if each.outcome and not each.internal)
        return list(dict.fromkeys(outcomes))

    def place(self, label, container, chart):
        """Tell the state where in the machine it is."""
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
        """Note that it has been left."""
        if self.current is not None:
            self.current.is_over = True

    def follow(self):
        """The activation that SMACH has come to."""
        with self.chart.changed:
            self.following = self._activations.popleft()
            if self.container is not None:
                self.container.following.entered.popleft()
            return self.following

    def wait(self, activation):
        """Wait until the state is left."""
        with self.chart.changed:
            self.chart.changed.wait_for(lambda: activation.is_over)

    # ---- for the chart

    def heard(self):
        """The events that the state waits for."""
        return [on.trigger for on in self.on if isinstance(on.trigger, Event)]

    def tables(self):
        """The states inside as the engine knows them."""
        return ()

    def table(self):
        """The state as the engine knows it."""
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
        )

    def initial_path(self):
        """The path of the state inside that is entered first."""
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
        """Where SMACH goes with the outcome of the transition, out of container after container."""
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
    """A state that does nothing itself.

    `outcomes` are further ones, for internal transitions of the states around.
    """

    def __init__(self, on=(), outcomes=(), after=None, on_entry=None, on_exit=None):
        own = self.describe(on, after, on_entry, on_exit)
        smach.State.__init__(self, [*own, *outcomes, 'preempted'])

    def execute(self, userdata):
        """Be active until the chart says that the state is left."""
        activation = self.follow()
        self.perform(activation)
        self.wait(activation)
        return activation.outcome or 'preempted'

    def perform(self, activation):
        """Do what the state does."""


class Final(State):
    """A state in which the state around it is done."""

    kind = engine.Kind.FINAL

    def table(self):
        """Also raises the event that says which final state it is."""
        done = engine.Event(joined('final', self.path))
        table = super().table()
        return table._replace(entry=(lambda instance, event: instance.raise_event(done),))


class History(State):
    """Leads to the state that was active when the container was left last, at first to `default`.

    `outcomes` are the labels of the states that this can be; `deep`: the states inside it too.
    """

    def __init__(self, default, outcomes, deep=False):
        super().__init__(outcomes=outcomes)
        self.kind = engine.Kind.DEEP_HISTORY if deep else engine.Kind.HISTORY
        self._default = default

    def table(self):
        """A history has one transition, to its default."""
        default = engine.Transition(targets=(joined(self.container.path, self._default),))
        return engine.State(self.path, self.kind, transitions=(default,))

    def execute(self, userdata):
        """Lead to what the chart has entered."""
        return self.container.next_label()


class Activity(State):
    """A state that has a server do something while it is active.

    `name` is that of the server; `store(userdata, result)` puts what comes of a success into
    userdata.
    """

    def __init__(self, name, store=None, **keywords):
        super().__init__(**keywords)
        self.name = name
        self._store = store
        self._wake = threading.Event()

    def table(self):
        """Also says which server works, and which events the outcomes are."""
        events = {outcome: self._event(outcome) for outcome in _OUTCOMES}
        if 'preempted' not in [each.trigger for each in self.on]:
            events['preempted'] = events['aborted']
        store = _with_event(self._store) if self._store else None
        activity = engine.Activity(self.name, self.name, events, finalize=store)
        return super().table()._replace(activity=activity)

    def request_preempt(self):
        """Make the call end."""
        super().request_preempt()
        self._wake.set()

    def perform(self, activation):
        """Call, unless the state has been left already."""
        with self.chart.changed:
            # A server that still stops for another state is waited for.
            self.chart.changed.wait_for(lambda: activation.run or activation.is_over)
            if activation.is_over:
                return
            activation.is_called = True
            self.recall_preempt()
            self._wake.clear()
        try:
            outcome, result = self.call()
            if outcome not in _OUTCOMES:
                raise ValueError('a callback returned {!r}, which is no outcome'.format(outcome))
        except Exception:
            outcome, result = 'aborted', None
            rospy.logerr('%s in state %s:\n%s', self.name, self.path, traceback.format_exc())
        self.chart.ended(activation, outcome, result)

    def call(self):
        """Have it done: the outcome and the result."""
        raise NotImplementedError

    def ask(self, callback, *arguments):
        """What a callback returns, during which nothing else happens in the machine."""
        with self.chart.changed:
            if callback is not None and not self.preempt_requested():
                return callback(self.container.userdata, *arguments)
        return None


def message(message_type, fields):
    """A message with these values in its fields."""
    made = message_type()
    genpy.message.fill_message_args(made, [fields])
    return made


class StartError(Exception):
    """The machine cannot begin as it is set up."""


def param(name, kind, *default):
    """The value of a ROS parameter, of a type or, with a list of one type, a list of such.

    Raises StartError where the value is something else; whole numbers are floats as well.
    """
    value = rospy.get_param(name, *default)
    if not _is(value, kind):
        wanted = 'list of {}'.format(kind[0].__name__) if isinstance(kind, list) else kind.__name__
        text = 'param {} is {!r}, which is no {}'
        raise StartError(text.format(rospy.resolve_name(name), value, wanted))
    return value


def require(callbacks, signatures):
    """Stop before anything moves when the user's file lacks what the model has come to use."""
    missing = [text for text in signatures if not hasattr(callbacks, text.partition('(')[0])]
    if missing:
        raise StartError('callbacks.py lacks {}'.format(', '.join(missing)))


def joined(*parts):
    """A path of those parts that there are."""
    return '.'.join(filter(None, parts))


def _is(value, kind):
    if isinstance(kind, list):
        return isinstance(value, list) and all(_is(each, kind[0]) for each in value)
    return type(value) in ((float, int) if kind is float else (kind,))


def _guard(function):
    """The guard as the engine calls it: one that has no value does not hold."""

    def call(instance, event):
        try:
            return function(instance.data, event.data)
        except Exception as error:
            rospy.logerr('a guard has no value: %r', error)
            return False

    return call


def _effect(function):
    return _with_event(lambda userdata, event: function(userdata), function)


def _with_event(function, named=None):
    """The function as the engine calls it; what goes wrong in it does not stop the machine."""

    def call(instance, event):
        try:
            return function(instance.data, event.data)
        except Exception as error:
            name = (named or function).__name__
            raise engine.ExecutionError('{} failed: {!r}'.format(name, error)) from error

    return call


def _start(name, delay):
    def start(userdata, event):
        return delay(userdata).to_nsec()

    length = _with_event(start, delay)
    return lambda instance, event: instance.send_after(
        engine.Event(name), length(instance, event), name
    )


def _cancel(name):
    return lambda instance, event: instance.cancel(name)
