"""Chart of a machine: runs the engine, which SMACH states and containers follow.

Each event, end of an activity or timeout runs to completion, as in SCXML: the enabled transitions
are taken, with all their effects in order, before the next one is processed. Later events wait in
a queue. The chart notes each state that is entered, and the outcome with which it is left. SMACH
takes the same route from state to state by the outcomes; it runs the activities, and shows the
active states.
"""

import heapq
import itertools
import threading
import time
from collections import deque

import rospy

from . import engine

# Pauses in seconds before a server is called again.
_FIRST_PAUSE = 0.1
_LONGEST_PAUSE = 1.0


class Activation:
    """One time that a state is active, from its entry to its exit.

    `outcome` is the outcome of the transition that ended it, `entered` has the labels of the
    states entered inside, in order, and `run` is the run of its activity.
    """

    def __init__(self):
        self.entered = deque()
        self.run = None
        self.is_called = False
        self.is_over = False
        self.outcome = None


class Pauses:
    """Pauses before servers are called again at once after they aborted a call, in seconds.

    The pause doubles with each abort in a row. Without it, a machine that tries again would call a
    server that fails at once some hundred times per second.
    """

    def __init__(self):
        self._aborted = {}

    def note(self, name, outcome):
        """Note the end of a call."""
        if outcome != 'aborted':
            self._aborted.pop(name, None)
            return
        _, pause = self._aborted.get(name, (0, 0))
        self._aborted[name] = time.monotonic(), min(max(2 * pause, _FIRST_PAUSE), _LONGEST_PAUSE)

    def before(self, name):
        """Return how long a call has to wait; a call that comes later ends the row."""
        since, pause = self._aborted.get(name, (0, 0))
        left = since + pause - time.monotonic()
        if left <= 0:
            self._aborted.pop(name, None)
        return max(left, 0)


class Chart(engine.Observer):
    """Runs the machine whose states are in the container `root`."""

    def __init__(self, root):
        self.changed = threading.Condition(threading.RLock())
        self.failure = None
        self.pauses = Pauses()
        self._root = root
        self._states = []
        self._timers = []
        self._count = itertools.count()
        self._clock = None
        self._left = []
        self._is_leaving = False
        self._place(root)
        table = engine.Machine('machine', root.tables(), root.initial_path())
        self._instance = engine.Instance(table, self, data=root.userdata, observer=self)
        # Last, because threads of rospy call the chart from here on.
        for event in dict.fromkeys(event for state in self._states for event in state.heard()):
            event.listen(self.receive)

    def _place(self, container):
        container.userdata = self._root.userdata
        container.edges = {
            (label, outcome): to for outcome, label, to in container.get_internal_edges()
        }
        self._states.append(container)
        for label, child in container.get_children().items():
            child.place(label, container, self)
            if hasattr(child, 'get_children'):
                self._place(child)
            else:
                self._states.append(child)

    # ---- called by states and containers

    def enter(self):
        """Enter the machine."""
        with self.changed:
            self._root.add_activation(Activation())
            self._do(self._instance.start)

    def leave(self):
        """Leave all states."""
        with self.changed:
            self._do(self._instance.stop)

    def receive(self, name, data=None, envelope=engine.NO_ENVELOPE):
        """Run an event to completion."""
        event = engine.Event(name, data, envelope=envelope)
        with self.changed:
            self._do(lambda: self._instance.receive(event))

    def ended(self, activation, outcome, result):
        """Run the end of an activity to completion."""
        with self.changed:
            activation.is_called = False
            self._do(lambda: activation.run.end(outcome, result))

    def fail(self, error):
        """End a machine that cannot go on."""
        with self.changed:
            self.failure = self.failure or error
            self._do(self._instance.stop)

    def _do(self, action):
        try:
            action()
        except Exception as error:  # a thread of rospy would only print it
            self.failure = self.failure or error
        if self.failure is not None:
            for state in self._states:
                state.end()
        elif not self._instance.running:
            self._root.end()
        self.changed.notify_all()

    # ---- observer of the engine

    def entered(self, instance, state):
        """Note that a state is active."""
        if state.origin is not None:  # final states of the machine itself are outcomes in SMACH
            state.origin.add_activation(Activation())

    def exited(self, instance, state):
        """Note that a state has been left."""
        if not self._is_leaving:
            self._is_leaving = True
            self._left = []
        if state.origin is not None:
            state.origin.end()
            self._left.append(state.origin)

    def taken(self, instance, transition):
        """Note the outcome of a transition; an internal one ends the state inside."""
        self._is_leaving = False
        if transition.origin is None or not transition.targets:
            return
        state, on = transition.origin
        for left in self._left:
            if (left.container if on.internal else left) is state:
                left.current.outcome = on.outcome

    # ---- world of the engine

    def start(self, run):
        """Let a state begin its activity as soon as SMACH executes it."""
        _state_of(run).current.run = run

    def cancel(self, run):
        """Stop an activity."""
        state = _state_of(run)
        if state.current.is_called:
            state.request_preempt()
        else:
            run.end('preempted')

    def send(self, instance, event):
        """Publish a delayed event, which has the function that does it; others are sent at once."""
        event.data()

    def failed(self, instance, error):
        """Log a guard or an effect that could not be evaluated; the machine continues."""
        rospy.logerr('%s', error)

    @property
    def time(self):
        """Return the ROS time in nanoseconds."""
        return rospy.Time.now().to_nsec()

    def schedule(self, delay, action):
        """Call an action after a delay in nanoseconds of ROS time."""
        timer = (rospy.Time.now() + rospy.Duration(delay / 1e9), next(self._count), action)
        heapq.heappush(self._timers, timer)
        if self._clock is None:
            self._clock = threading.Thread(target=self._watch_clock, name='clock')
            self._clock.daemon = True
            self._clock.start()
        return timer

    def unschedule(self, timer):
        """Cancel a delayed call."""
        if timer in self._timers:
            self._timers.remove(timer)
            heapq.heapify(self._timers)

    def _watch_clock(self):
        with self.changed:
            while self._timers:
                if rospy.Time.now() < self._timers[0][0]:
                    self.changed.wait(0.02)
                else:
                    self._do(heapq.heappop(self._timers)[2])
            self._clock = None


def _state_of(run):
    return run.instance.machine.states[run.state].origin
