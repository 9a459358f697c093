"""Functions of the robot: non-blocking calls of action and service servers."""

from typing import Any, NamedTuple

from action_msgs.msg import GoalStatus, GoalStatusArray
from rclpy.action import ActionClient
from rclpy.qos import qos_profile_action_status_default

from .values import SECOND

_LOOK = SECOND // 10
"""Interval of checks for a missing server, in nanoseconds."""
_WATCH = SECOND // 2
"""Interval of checks that a working server is still there, in nanoseconds."""
_STATUS = '{}/_action/status'
"""Topic on which an action server publishes the status of its goals."""
_RESPONSE = 'rr{}Reply'
"""Topic of DDS on which a service server publishes its responses."""
_REPLACED = 'has another server, which does not know of it'
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
        return _ActionCall(host, self, client, run, self.interface.Goal())

    def servers(self, node):
        """Return the servers that are in the graph; one that starts again is another one."""
        return _ids(node.get_publishers_info_by_topic(_STATUS.format(self.name)))


class Service(NamedTuple):
    """A function of a service server."""

    interface: Any
    name: str

    def client(self, node, group):
        """Create a client of the server."""
        return node.create_client(self.interface, self.name, callback_group=group)

    def call(self, host, client, run):
        """Create a call without sending it."""
        return _ServiceCall(host, self, client, run, self.interface.Request())

    def servers(self, node):
        """Return the servers that are in the graph; empty if ROS does not run on DDS."""
        topic = _RESPONSE.format(node.resolve_service_name(self.name))
        return _ids(node.get_publishers_info_by_topic(topic, no_mangle=True))


def _ids(publishers):
    return frozenset(bytes(each.endpoint_gid) for each in publishers)


class _Call:
    """
    One run of an activity, from the search for its server until the server is free again.

    `host` has the clock, the timeouts and the log, and runs the steps of all calls one by one.
    """

    def __init__(self, host, function, client, run, empty):
        self._host = host
        self._function = function
        self._client = client
        self._run = run
        self._goal = run.goal if run.goal is not None else empty
        self._sent = False
        self._cancelled = False
        self._over = False
        self._missing_since = None
        self._servers = frozenset()  # those that may know the goal or request

    def __str__(self):
        """Return the function and the name of its server."""
        activity = self._run.activity
        return f'{activity.name} on {activity.server}'

    @property
    def is_waiting(self):
        """Return True while the server is missing."""
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
            self._servers = self._find_servers()
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
        """Check that the server is still there, and not another one instead."""
        if self._over:
            return
        if self._is_ready() and self._is_known():
            self._missing_since = None
        elif self._is_missing_for_long():
            return
        self._host.later(_WATCH, self._watch)

    def _find_servers(self):
        return self._host.servers(self._function)

    def _is_missing_for_long(self):
        """Abort the call after the server timeout; return True if it is aborted."""
        now = self._host.now
        if self._missing_since is None:
            self._missing_since = now
        if now - self._missing_since < self._host.server_timeout:
            return False
        if self._is_ready():
            self._warn(_REPLACED)
        else:
            self._warn('has lost its server' if self._sent else 'has no server')
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
    _inquiry = None  # a subscription to the status of goals

    def _is_ready(self):
        return self._client.server_is_ready()

    def _is_known(self):
        """
        Return True; if the servers are not those that the goal was sent to, ask for the goal.

        The middleware keeps a server that was killed in the graph for a while, also beside its
        successor, which does not know the goal. Every server that is there tells a new
        subscription the status of its goals, even while it is busy.
        """
        if self._handle is not None and self._inquiry is None:
            servers = self._find_servers()
            if servers != self._servers:
                self._inquire(servers)
        return True

    def _inquire(self, servers):
        def hear(status):
            known = [bytes(each.goal_info.goal_id.uuid) for each in status.status_list]
            if self._inquiry is made and bytes(self._handle.goal_id.uuid) in known:
                self._stop_inquiry()
                if servers != self._servers:
                    self._servers = servers
                    self._host.logger.info(f'{self} has other servers, and is still worked on')

        def give_up():
            if self._inquiry is made:
                self._warn(_REPLACED)
                self._stop()  # in case that a server works on it behind a broken network
                self._end('aborted')

        topic = _STATUS.format(self._function.name)
        qos = qos_profile_action_status_default
        made = self._inquiry = self._host.subscribe(GoalStatusArray, topic, hear, qos)
        self._host.later(self._host.server_timeout, give_up)

    def _stop_inquiry(self):
        if self._inquiry is not None:
            self._host.unsubscribe(self._inquiry)
            self._inquiry = None

    def drop(self):
        """Ignore the answer of the server."""
        super().drop()
        self._stop_inquiry()

    def _end(self, outcome, result=None):
        self._stop_inquiry()
        super()._end(outcome, result)

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
        self._ask_for_result()
        if self._cancelled:
            self._stop()

    def _ask_for_result(self):
        if not self._over:
            self._then(self._handle.get_result_async(), self._finished)

    def _finished(self, future):
        if self._over:
            return
        answer = self._answer(future)
        if answer is None:
            return
        if answer.status != GoalStatus.STATUS_UNKNOWN:
            self._end(_OUTCOMES.get(answer.status, 'aborted'), answer.result)
            return
        # All servers are asked, and the first to answer does not know the goal, or not yet.
        if self._inquiry is None:
            self._inquire(self._find_servers())
        self._host.later(_WATCH, self._ask_for_result)

    def _stop(self):
        if self._handle is not None:
            self._handle.cancel_goal_async()


class _ServiceCall(_Call):
    """A call of a service, which cannot be cancelled: it ends with the response."""

    def _is_ready(self):
        return self._client.service_is_ready()

    def _is_known(self):
        """Return True while a server to which the request was sent is in the graph."""
        return not self._servers or not self._servers.isdisjoint(self._find_servers())

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
