"""
Process with the nodes of many robots, each of which begins, fails and ends by itself.

A launch file writes a file with the nodes: the module of each, its namespace in that of the
process, and its own arguments of ROS.
"""

from functools import partial
from importlib import import_module
import json
from pathlib import Path
import queue
import signal
import sys
import threading
import traceback
from typing import Any, NamedTuple

import rclpy
from rclpy.logging import get_logger
from rclpy.signals import SignalHandlerOptions

from .node import end_in, leave, Spinner, StateMachineNode
from .robots import delay, RobotError

_LATE = 20.0
"""Time that ROS may take to shut down all nodes after they have stopped, in seconds."""
_USAGE = 'usage: container [--respawn SECONDS] FILE [ARGUMENT OF ROS ...]'


class Start(NamedTuple):
    """A node to start: the module of its machine, its namespace, and its arguments of ROS."""

    module: str
    namespace: str
    arguments: Any


class Command(NamedTuple):
    """The nodes, the pause after which a failed one starts again, and arguments of the process."""

    nodes: Any
    respawn: Any
    arguments: Any


class UsageError(Exception):
    """The process cannot be started with these arguments."""


def read(arguments):
    """Return the command in the arguments; raise UsageError if they are something else."""
    words = list(arguments)
    respawn = None
    try:
        if words[0] == '--respawn':
            respawn = delay(words[1])
            del words[:2]
        path = Path(words.pop(0))
        nodes = [Start(*each) for each in json.loads(path.read_text(encoding='utf-8'))]
    except (IndexError, RobotError):
        raise UsageError(_USAGE) from None
    except (OSError, ValueError, TypeError) as error:
        raise UsageError(f'{path} is no file with nodes: {error}') from None
    if not nodes:
        raise UsageError(_USAGE)
    return Command(nodes, respawn, words)


class _Ros:
    """ROS in a process with many nodes: it begins with the first of them."""

    def __init__(self, arguments):
        self._arguments = arguments
        self._lock = threading.Lock()
        self._has_begun = False
        self.making = threading.Lock()  # one node is made at a time

    def begin(self):
        """Initialize ROS, unless another node has done so."""
        with self._lock:
            if not self._has_begun:
                rclpy.init(args=self._arguments, signal_handler_options=SignalHandlerOptions.NO)
                self._has_begun = True

    def end(self):
        """Leave ROS to the other nodes."""


class _Robot(threading.Thread):
    """Runs one node, and starts it again after a failure if there is a `pause`."""

    def __init__(self, start, space, ros, pause, on_end):
        super().__init__(name=start.namespace, daemon=True)
        self._module = start.module
        self._name = f'{start.module} in {start.namespace}'
        namespace = f'{space.rstrip("/")}/{start.namespace}'
        self._arguments = ['--ros-args', '-r', f'__ns:={namespace}', *start.arguments]
        self._ros = ros
        self._pause = pause
        self._on_end = on_end
        self._ending = queue.SimpleQueue()
        self._is_to_end = threading.Event()
        self._spinner = None
        self.code = 0

    @property
    def stopping(self):
        """Return the time that the node may take to stop, in seconds."""
        return 0.0 if self._spinner is None else self._spinner.stopping

    def end(self):
        """End the node; it does not start again."""
        self._is_to_end.set()
        self._ending.put(None)

    def run(self):
        """Run the node until it ends, or until `end` is called."""
        try:
            self._run()
        except Exception:
            traceback.print_exc()
            self.code = 1
        finally:
            self._on_end()

    def _run(self):
        while not self._is_to_end.is_set():
            self._spinner = Spinner(self._make, self._module, self._ros, self._has_ended)
            self._spinner.start()
            self._ending.get()
            self.code = self._spinner.end(_unlimited)
            if not self.code or self._is_to_end.is_set():
                break
            if self._pause is None:
                get_logger('container').error(f'{self._name} has failed')
                break
            get_logger('container').error(f'{self._name} has failed, and starts again')
            self._is_to_end.wait(self._pause)
            self._ending = queue.SimpleQueue()

    def _make(self, name, on_end):
        module = import_module(f'.{self._module}', __package__)
        with self._ros.making:
            return StateMachineNode(module.BEHAVIOR, name, on_end, cli_args=self._arguments)

    def _has_ended(self):
        self._ending.put(None)


def _unlimited(seconds, code):
    """Return a timer that does nothing: one node that hangs does not end the others."""
    return threading.Timer(seconds, int)


def _namespace(arguments):
    """Return the namespace of the process, as a launch file sets it."""
    rules = (each.partition(':=') for each in arguments)
    return next((value for name, _, value in rules if name == '__ns'), '')


def main(args=None):
    """Run all nodes until they have ended or a signal comes; end the process."""
    try:
        command = read(sys.argv[1:] if args is None else args)
    except UsageError as error:
        sys.exit(str(error))
    news = queue.SimpleQueue()
    for each in (signal.SIGINT, signal.SIGTERM):
        signal.signal(each, lambda *_: news.put('signal'))
    ros = _Ros([sys.argv[0], *command.arguments])
    space = _namespace(command.arguments)
    robots = [
        _Robot(each, space, ros, command.respawn, partial(news.put, 'end'))
        for each in command.nodes
    ]
    for robot in robots:
        robot.start()
    running = len(robots)
    while running and news.get() == 'end':
        running -= 1
    end_in(max(robot.stopping for robot in robots) + _LATE, 1)
    for robot in robots:
        robot.end()
    for robot in robots:
        robot.join()
    rclpy.try_shutdown()
    leave(max(robot.code for robot in robots))


if __name__ == '__main__':
    main()
