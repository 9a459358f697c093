"""
Node that calls a function when the process of another node on its computer has died.

It has no part in the behaviour: it waits until the lock of the other node's lease is free. Goals
of actions that the node may have left behind are cancelled.
"""

import fcntl
from importlib import import_module
from pathlib import Path
import threading
import time

from action_msgs.srv import CancelGoal
import rclpy
from rclpy.action import ActionClient
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

from . import lease, parameters
from .parameters import Parameter, StartError

_SETTINGS = (
    Parameter('lease.file', 'string', None, 'File that the node has locked.'),
    Parameter('function', 'string', None, 'Server that is called when the node has died.'),
    Parameter('paradigm', 'string', 'service', 'Whether it is a `service` or an `action`.'),
    Parameter('type', 'string', None, 'Its type, such as std_srvs/srv/Empty.'),
    Parameter('cancels', 'string', '', 'Actions of which all goals are cancelled before.'),
)
_PAUSE = 0.1
_LATE = 5.0
"""Time after which a missing server is logged, in seconds, and again after each such time."""


class WatchdogNode(Node):
    """Watches the lease of a node; calls a function once each time its process has died."""

    def __init__(self):
        super().__init__('watchdog')
        parameters.declare(self, _SETTINGS)
        self._settings = settings = parameters.values(self, _SETTINGS)
        package, kind, name = settings['type'].split('/')
        self._type = getattr(import_module(f'{package}.{kind}'), name)
        # Servers are known before they are needed.
        if settings['paradigm'] == 'action':
            self._client = ActionClient(self, self._type, settings['function'])
        else:
            self._client = self.create_client(self._type, settings['function'])
        self._cancels = {
            action: self.create_client(CancelGoal, f'{action}/_action/cancel_goal')
            for action in settings['cancels'].split()
        }
        self._died = self.create_guard_condition(self._call)
        try:
            Path(settings['lease.file']).parent.mkdir(parents=True, exist_ok=True)
            self._file = Path(settings['lease.file']).open('a+', encoding='utf-8')  # noqa: SIM115
        except OSError as error:
            raise StartError(f'parameter `lease.file`: {error}') from None
        if lease.locked(self._file):
            # A process that ended before is none that this watchdog has watched.
            lease.note(self._file, '')
            fcntl.flock(self._file, fcntl.LOCK_UN)
        threading.Thread(target=self._watch, name='lease', daemon=True).start()
        self.get_logger().info(f'{settings["lease.file"]} is watched')

    def _watch(self):
        """Wait for the end of each process that has the lease."""
        while True:
            while not self._said():
                time.sleep(_PAUSE)
            fcntl.flock(self._file, fcntl.LOCK_EX)
            said = self._said()
            lease.note(self._file, '')
            fcntl.flock(self._file, fcntl.LOCK_UN)
            if said == lease.RUNNING:
                self._died.trigger()

    def _said(self):
        self._file.seek(0)
        return self._file.read()

    def _call(self):
        """Cancel the goals of the dead node, and call the function."""
        function = self._settings['function']
        self.get_logger().error(f'the node has died: {function} is called')
        for client in self._cancels.values():
            if client.service_is_ready():
                client.call_async(CancelGoal.Request())  # of no goal: all goals
        late = time.monotonic() + _LATE
        while not self._is_ready():
            if not rclpy.ok():
                return
            if time.monotonic() > late:
                self.get_logger().error(f'{function} has no server')
                late += _LATE
            time.sleep(_PAUSE)
        if self._settings['paradigm'] == 'action':
            called = self._client.send_goal_async(self._type.Goal())
        else:
            called = self._client.call_async(self._type.Request())
        called.add_done_callback(lambda _: self.get_logger().info(f'{function} has answered'))

    def _is_ready(self):
        if self._settings['paradigm'] == 'action':
            return self._client.server_is_ready()
        return self._client.service_is_ready()


def main(args=None):
    """Watch until a signal comes."""
    rclpy.init(args=args)
    try:
        rclpy.spin(WatchdogNode())
    except StartError as error:
        rclpy.logging.get_logger('watchdog').fatal(str(error))
        raise SystemExit(1) from None
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
