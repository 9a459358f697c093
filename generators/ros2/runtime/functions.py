"""Functions of the robot: non-blocking calls of action and service servers."""

from typing import Any, NamedTuple

from action_msgs.msg import GoalStatus
from rclpy.action import ActionClient

from .values import SECOND

_LOOK = SECOND // 10
"""Interval of checks for a missing server, in nanoseconds."""
_WATCH = SECOND // 2
"""Interval of checks that a working server is still there, in nanoseconds."""
_OUTCOMES = {
    GoalStatus.STATUS_SUCCEEDED: 'succeeded',
    GoalStatus.STATUS_CANCELED: 'preempted',
}


class Action(NamedTuple):
    """A function of an action server."""

    interface: Any
    name: str

    def client(self, node, group):
        """Create a client of the server."""
        return ActionClient(node, self.interface, self.name, callback_group=group)

    def call(self, host, client, run):
        """Create a call without sending it."""
        return _ActionCall(host, client, run, self.interface.Goal())


class Service(NamedTuple):
    """A function of a service server."""

    interface: Any
    name: str

    def client(self, node, group):
        """Create a client of the server."""
        return node.create_client(self.interface, self.name, callback_group=group)

    def call(self, host, client, run):
        """Create a call without sending it."""
        return _ServiceCall(host, client, run, self.interface.Request())


class _Call:
    """
    One run of an activity, from the search for its server until the server is free again.

    `host` has the clock, the timeouts and the log, and runs the steps of all calls one by one.
    """

    def __init__(self, host, client, run, empty):
        self._host = host
        self._client = client
        self._run = run
        self._goal = run.goal if run.goal is not None else empty
        self._sent = False
        self._cancelled = False
        self._over = False
        self._missing_since = None

    def __str__(self):
        """Return the function and the name of its server."""
        activity = self._run.activity
        return f'{activity.name} on {activity.server}'

    @property
    def is_waiting(self):
        """True while the server is missing."""
        return self._missing_since is not None

    @property
    def progress(self):
        """Progress of the call, for people."""
        if self._cancelled:
            return 'is cancelled'
        return 'works' if self._sent else 'waits for its server'

    def begin(self):
        """Send the goal or request as soon as there is a server."""
        if self._over:
            return
        if self._is_ready():
            self._sent = True
            self._missing_since = None
            self._send()
            self._host.later(_WATCH, self._watch)
        elif not self._is_missing_for_long():
            self._host.later(_LOOK, self.begin)

    def cancel(self):
        """Ask the server to stop, and wait for it up to a timeout."""
        self._cancelled = True
        if not self._sent:
            self._end('preempted')
            return
        self._host.later(self._host.cancel_timeout, self._give_up)
        self._stop()

    def drop(self):
        """Ignore the answer of the server."""
        self._over = True

    def _watch(self):
        """Check that the server is still there."""
        if self._over:
            return
        if self._is_ready():
            self._missing_since = None
        elif self._is_missing_for_long():
            return
        self._host.later(_WATCH, self._watch)

    def _is_missing_for_long(self):
        """Abort the call after the server timeout; return True if it is aborted."""
        now = self._host.now
        if self._missing_since is None:
            self._missing_since = now
        if now - self._missing_since < self._host.server_timeout:
            return False
        self._warn('has no server')
        self._end('aborted')
        return True

    def _give_up(self):
        if not self._over:
            self._warn('does not stop')
            self._end('preempted')

    def _then(self, future, action):
        """Post an action with a future when it is done."""
        future.add_done_callback(lambda done: self._host.post(lambda: action(done)))

    def _answer(self, future):
        """Return the result of a future; warn, abort and return None if it failed."""
        if future.exception() is not None:
            self._warn(f'failed: {future.exception()}')
            self._end('aborted')
            return None
        return future.result()

    def _end(self, outcome, result=None):
        if self._over:
            return
        self._over = True
        self._host.forget(self._run)
        self._run.end('preempted' if self._cancelled else outcome, result)

    def _warn(self, what):
        self._host.warn(f'{self} {what}')


class _ActionCall(_Call):
    """A call of an action server."""

    _handle = None

    def _is_ready(self):
        return self._client.server_is_ready()

    def _send(self):
        self._then(self._client.send_goal_async(self._goal), self._accepted)
        self._host.later(self._host.server_timeout, self._look_whether_accepted)

    def _look_whether_accepted(self):
        """Abort a goal that the server neither accepts nor rejects."""
        if self._handle is None and not self._over:
            self._warn('does not answer')
            self._end('aborted')

    def _accepted(self, future):
        handle = None if future.exception() is not None else future.result()
        if self._over:
            # The server has answered too late.
            if handle is not None and handle.accepted:
                handle.cancel_goal_async()
            return
        handle = self._answer(future)
        if handle is None:
            return
        if not handle.accepted:
            self._warn('was rejected')
            self._end('aborted')
            return
        self._handle = handle
        self._then(handle.get_result_async(), self._finished)
        if self._cancelled:
            self._stop()

    def _finished(self, future):
        if self._over:
            return
        answer = self._answer(future)
        if answer is not None:
            self._end(_OUTCOMES.get(answer.status, 'aborted'), answer.result)

    def _stop(self):
        if self._handle is not None:
            self._handle.cancel_goal_async()


class _ServiceCall(_Call):
    """A call of a service, which cannot be cancelled: it ends with the response."""

    def _is_ready(self):
        return self._client.service_is_ready()

    def _send(self):
        self._future = self._client.call_async(self._goal)
        self._then(self._future, self._responded)

    def _responded(self, future):
        if self._over:
            return
        response = self._answer(future)
        if response is None:
            return
        outcome = 'succeeded'
        if getattr(response, 'success', True) is False:
            outcome = self._run.activity.refused
        if outcome == 'aborted':
            self._warn(f'was refused: {getattr(response, "message", "")}'.rstrip(': '))
        self._end(outcome, response)

    def _stop(self):
        """Do nothing, because a request cannot be cancelled."""

    def _give_up(self):
        self._client.remove_pending_request(self._future)
        super()._give_up()
