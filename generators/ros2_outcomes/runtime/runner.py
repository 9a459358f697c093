"""Node that runs a machine of the library, and the engine that the machine follows."""

from threading import current_thread, Thread
import time
import traceback
from typing import Any, NamedTuple

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node

from . import host, library
from .values import SECOND

_MARGIN = 5.0
"""Time that everything except the servers may take to stop, in seconds."""
_LOOK = 0.5
"""Interval in which an engine with its own node checks that ROS still runs, in seconds."""


class Fsm(NamedTuple):
    """A state machine: its behavior, its chart, and the function that builds it."""

    behavior: Any
    chart: Any
    build: Any


class Data:
    """Params and variables of a machine, stored in the memory of the library."""

    def __init__(self, memory, values):
        vars(self)['_memory'] = memory
        for name, value in values.items():
            memory[name] = value

    def __getattr__(self, name):
        try:
            return self._memory[name]
        except (KeyError, RuntimeError) as error:
            raise AttributeError(f'there is nothing called `{name}`') from error

    def __setattr__(self, name, value):
        self._memory[name] = value


class Follower:
    """Observer of the engine that informs both the chart and the trace."""

    def __init__(self, chart, trace):
        self._chart = chart
        self._trace = trace

    def __getattr__(self, name):
        return getattr(self._trace, name)

    def received(self, instance, event):
        """Inform both."""
        self._trace.received(instance, event)
        self._chart.received(event)

    def exited(self, instance, state):
        """Inform both."""
        self._trace.exited(instance, state)
        self._chart.exited(state)

    def taken(self, instance, transition):
        """Inform both."""
        self._trace.taken(instance, transition)
        self._chart.taken(transition)

    def entered(self, instance, state):
        """Inform both."""
        self._trace.entered(instance, state)
        self._chart.entered(state)


class Engine(host.Host):
    """
    Engine of a machine in a node, for states of the library.

    Threads of the library run their requests on the executor of the node: an action client that
    sends in another thread may lose the answer of its server.
    """

    def __init__(self, node, behavior, chart, on_end):
        self._chart = chart
        self._first = behavior.data
        chart.host = self
        parameters = (*behavior.parameters, library.SHOWN)
        behavior = behavior._replace(data=self._data, parameters=parameters)
        super().__init__(node, behavior, on_end=on_end)

    def begin_engine(self):
        """Start the engine from its beginning, when the library starts."""
        self._hand_over(lambda: host.Host.begin(self))

    def begin_activity(self, activation):
        """Begin the activity of a state that the library executes."""
        self._hand_over(lambda: self.post(lambda: self._begin_activity(activation)))

    def end_engine(self):
        """Make the engine leave all states."""
        self._hand_over(lambda: host.Host.end(self, self._chart.released))

    def start(self, run):
        """Begin an activity as soon as the library executes its state."""
        if not self._chart.holds(run):
            super().start(run)

    def cancel(self, run):
        """Stop an activity."""
        if self._chart.drops(run):
            run.end('preempted')
        else:
            super().cancel(run)

    def observer(self):
        """Return the observer, which informs the chart as well."""
        return Follower(self._chart, super().observer())

    def _hand_over(self, action):
        while self._node.executor is None:  # set when the node is added to an executor
            time.sleep(0.01)
        self._node.executor.create_task(action)

    def _begin(self):
        if self._chart.is_wanted:
            super()._begin()
        self._chart.begun()

    def _not_begun(self):
        self._chart.begun()

    def _begin_activity(self, activation):
        run, activation.run = activation.run, None
        if run is not None:
            super().start(run)

    def _data(self, values):
        return Data(self._chart.memory, vars(self._first(values)))

    def _run(self, action):
        super()._run(action)
        self._chart.settle(self._instance is not None and self._instance.running)

    def _fail(self, what):
        super()._fail(what)
        self._chart.stop()


class Host(Engine):
    """Engine and machine of the library in a node of their own."""

    def __init__(self, node, fsm, on_end):
        super().__init__(node, fsm.behavior, fsm.chart, self._engine_ended)
        self._fsm = fsm
        self._on_outcome = on_end
        self._has_failed = False
        self._thread = None
        self._is_to_run = False
        self._machine = None

    def configure(self):
        """Create all clients and topics, and the machine."""
        super().configure()
        if self._machine is None:  # its viewer cannot be created twice
            is_shown = self._values[library.SHOWN.name]
            self._machine = library.make(self._fsm, self._node, is_shown)

    def begin(self):
        """Run the machine in the library; the engine begins with it."""
        arguments = (self._thread,)
        with self._chart.changed:
            self._is_to_run = True
            self._thread = Thread(
                target=self._execute, args=arguments, name='state machine', daemon=True
            )
        self._thread.start()

    def end(self, then=lambda: None):
        """End the machine, and call `then` when no server works for it any more."""
        with self._chart.changed:
            self._is_to_run = False
            self._chart.is_closed = True
        super().end(then)

    def _execute(self, earlier):
        """Run the machine as soon as the thread that ran it before has ended."""
        try:
            if earlier is not None:
                earlier.join(self.cancel_timeout / SECOND + _MARGIN)
                if earlier.is_alive():
                    raise TimeoutError('the machine cannot begin anew: it does not end')
            with self._chart.changed:  # a later `begin` or `end` takes precedence
                is_last = self._thread is current_thread()
                self._chart.is_closed = not (self._is_to_run and is_last)
            outcome = library.run(self._machine)
        except Exception:
            self.logger.fatal(traceback.format_exc())
            self._has_failed = True
        else:
            self.logger.info(f'the machine of {library.NAME} has ended with {outcome}')
        self._on_outcome(self._has_failed)

    def _engine_ended(self, failed):
        """Note a failure; the node ends when the machine of the library ends."""
        self._has_failed = self._has_failed or failed


def in_node_of_its_own(behavior, name):
    """Return a function that makes a node and its engine, for a machine in your own program."""

    def make(chart):
        if not rclpy.ok():
            rclpy.init()
        node = Node(name)
        engine = Engine(node, behavior, chart, lambda failed: None)
        engine.configure()
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        Thread(target=_spin, args=(executor, chart), name='engine', daemon=True).start()
        return engine

    return make


def _spin(executor, chart):
    try:
        # A signal does not wake an executor that begins to wait while ROS shuts down.
        while rclpy.ok():
            executor.spin_once(timeout_sec=_LOOK)
    except ExternalShutdownException:
        pass
    finally:
        chart.is_closed = True
        chart.stop()
