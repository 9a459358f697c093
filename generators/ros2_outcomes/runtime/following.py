"""Chart of a state machine: makes the states of a library follow the engine."""

from collections import deque
from threading import Condition, RLock
from typing import Any, NamedTuple

from .states import STOPPED


class Way(NamedTuple):
    """
    Outcome with which a transition of the chart leaves states in the library.

    The active states in `left` end with `outcome`, a string, or a dict from event names to
    strings; `history` is the junction of the history state that the transition leads to.
    """

    outcome: Any
    left: str
    history: str = ''


class Activation:
    """
    One time that a state is active, from its entry to its exit.

    `outcome` is set when the state is left; `run` is the run of its activity until that begins.
    """

    def __init__(self):
        self.outcome = None
        self.run = None
        self.has_come = False


class Chart:
    """
    Connects the engine with the states of a machine in the library.

    The engine enters and leaves states; the library executes each of them later, stays in it
    until the engine has left it, and continues with the outcome of the transition. States that
    the library has not executed yet wait in a queue for each state. An activity begins when the
    library executes its state.

    `ways` has a `Way` for each transition of a state, None for one that leads nowhere; `entries`
    has the name of the junction in which a machine begins, by the id of the state. `host` runs
    the engine; `make_host` makes it when the library begins without one.
    """

    def __init__(self, machine, make_host, ways, entries):
        self.changed = Condition(RLock())
        self.host = None
        self.memory = None
        self.is_closed = False
        self._make_host = make_host
        self._ways = {
            id(transition): way
            for state in machine.states
            if state.id in ways
            for transition, way in zip(state.transitions, ways[state.id], strict=True)
        }
        self._entries = entries
        self._is_running = self._has_begun = self._is_stopped = self._is_canceling = False
        self._event = None
        self._clear()

    def _clear(self):
        self._queues = {}
        self._current = {}
        self._junctions = {}
        self._left = []

    # ---- called by states

    def visit(self, path, memory):
        """Wait until the engine has left a state; return the outcome."""
        with self.changed:
            begins = not self._is_running and not self._queues.get(path) and not self.is_closed
            if begins:
                self._clear()
                self._is_running, self._has_begun, self._is_stopped = True, False, False
                self.memory = memory
        if begins:
            if self.host is None:
                self.host = self._make_host(self)
            self.host.begin_engine()
        with self.changed:
            self.changed.wait_for(lambda: self._queues.get(path) or not self._is_running)
            if not self._queues.get(path):
                return STOPPED
            activation = self._queues[path].popleft()
            activation.has_come = True
        if activation.run is not None:
            self.host.begin_activity(activation)
        with self.changed:
            self.changed.wait_for(
                lambda: activation.outcome is not None and not self._is_canceling
            )
        return activation.outcome

    def cancel(self):
        """Make the engine leave all states; they end when no server works any more."""
        self._is_stopped = True
        if self.host is not None:
            self._is_canceling = True
            self.host.end_engine()

    # ---- called by the host

    @property
    def is_wanted(self):
        """Return True unless the machine has been stopped before the engine begins."""
        return not (self.is_closed or self._is_stopped)

    def begun(self):
        """Note that the engine has begun or never will: from now on `settle` says if it runs."""
        self._has_begun = True

    def released(self):
        """Note that no server works any more."""
        with self.changed:
            self._is_canceling = False
            self.changed.notify_all()

    def holds(self, run):
        """Keep an activity until the library executes its state; return True if it is kept."""
        with self.changed:
            activation = self._current[_state_of(run)]
            if not activation.has_come:
                activation.run = run
            return not activation.has_come

    def drops(self, run):
        """Drop an activity that is kept; return True if it was kept."""
        with self.changed:
            activation = self._current[_state_of(run)]
            was_kept, activation.run = activation.run is run, None
            return was_kept

    def settle(self, is_running):
        """Let the library continue after a step of the engine."""
        with self.changed:
            for path in self._left:
                self._end(path, STOPPED)
            self._left.clear()
            if self._has_begun:
                self._is_running = is_running
            self.changed.notify_all()

    def stop(self):
        """End all states, because the engine has failed."""
        with self.changed:
            for activation in self._current.values():
                activation.outcome = activation.outcome or STOPPED
            self._has_begun, self._is_canceling = True, False
            self.settle(False)

    # ---- called by the engine, through its observer

    def received(self, event):
        """Note the event that is processed."""
        self._event = event.name

    def exited(self, state):
        """Note that a state has been left; `taken` then says by which transition."""
        self._left.append(state.id)

    def taken(self, transition):
        """End the states that a transition has left with its outcome."""
        way = self._ways.get(id(transition))
        if way is None:
            return
        outcome = way.outcome if isinstance(way.outcome, str) else way.outcome[self._event]
        for path in [each for each in self._left if _is_in(each, way.left)]:
            self._left.remove(path)
            self._end(path, outcome)
        if way.history:
            around = way.history.rpartition('.')[0]
            self._junctions[around] = self._enter(way.history)

    def entered(self, state):
        """Note that a state is active."""
        around, _, name = state.id.rpartition('.')
        with self.changed:
            if around in self._junctions:
                self._junctions.pop(around).outcome = name
            if state.id in self._entries:
                self._junctions[state.id] = self._enter(f'{state.id}.{self._entries[state.id]}')
            if not state.states:
                self._current[state.id] = self._enter(state.id)

    def _enter(self, path):
        activation = Activation()
        self._queues.setdefault(path, deque()).append(activation)
        return activation

    def _end(self, path, outcome):
        activation = self._current.get(path)
        if activation is not None:
            activation.outcome = outcome


def _state_of(run):
    return run.instance.machine.states[run.state].id


def _is_in(state, around):
    return not around or state == around or state.startswith(f'{around}.')
