"""Services as states that can be left during the call.

A `smach_ros.ServiceState` waits forever for a missing service, and cannot be preempted while it
waits for a response.
"""

import io
import socket
import threading
import time

import rospy

from .states import Activity

# Defaults of timeouts in seconds, from the options of swarmc.
_MISSING_SERVER = 10
_DEAD_SERVER = 5


class ServiceState(Activity):
    """Calls a service and waits for its response.

    `request_cb(userdata, request)` fills the request or returns another one;
    `response_cb(userdata, response)` reads the response. The state is aborted when there is no
    service within `~timeouts/missing_server` seconds, when the call fails, for example because the
    server dies, when the node of the server answers no probe for `~timeouts/dead_server` seconds,
    for example because it is frozen, and when a callback fails. It ends with `refused` when field
    `success` of the response is false. When the state is left, it ends at once and ignores a later
    response.
    """

    def __init__(
        self,
        name,
        spec,
        request=None,
        request_cb=None,
        response_cb=None,
        refused='aborted',
        **keywords,
    ):
        super().__init__(name, **keywords)
        self._refused = refused
        self._spec = spec
        self._request = request
        self._request_cb = request_cb
        self._response_cb = response_cb
        self._missing = rospy.get_param('~timeouts/missing_server', _MISSING_SERVER)
        self._dead = rospy.get_param('~timeouts/dead_server', _DEAD_SERVER)

    def call(self):
        """Return the outcome and the response."""
        request = self._spec._request_class() if self._request is None else self._request
        request = self.ask(self._request_cb, request) or request
        call = _Call(self.name, self._spec, request, self._missing, self._wake)
        call.start()
        while not self.preempt_requested() and not call.has_ended:
            if not self._wake.wait(self._dead):
                call.watch(self._dead)
            self._wake.clear()
        call.is_left = True
        if self.preempt_requested():
            return 'preempted', None
        try:
            response = call.answer()
        except (rospy.ROSException, rospy.ServiceException) as error:
            rospy.logerr('service %s: %s', self.name, error)
            return 'aborted', None
        outcome = 'succeeded'
        if getattr(response, 'success', True) is False:
            outcome = self._refused
        if outcome == 'aborted':
            rospy.logwarn('service %s was refused: %s', self.name, getattr(response, 'message', ''))
        else:
            self.ask(self._response_cb, response)
        return outcome, response


class _Call(threading.Thread):
    """One call in a thread of its own; `is_left` says that nobody waits for it."""

    def __init__(self, name, spec, request, patience, wake):
        super().__init__(name='service ' + name, daemon=True)
        self.has_ended = self.is_left = False
        self._service = name
        self._spec = spec
        self._request = request
        self._patience = patience
        self._wake = wake
        self._proxy = None
        self._is_watched = False
        self._response = self._error = None

    def run(self):
        """Wait for the service and call it."""
        try:
            rospy.wait_for_service(self._service, self._patience)
            if not self.is_left:
                self._proxy = rospy.ServiceProxy(self._service, self._spec)
                self._end(self._proxy(self._request), None)
        except Exception as error:
            self._end(None, error)

    def watch(self, patience):
        """Check from now on, in another thread, that the node of the server answers."""
        if self._proxy is not None and not self._is_watched:
            self._is_watched = True
            threading.Thread(target=self._watch, args=(patience,), daemon=True).start()

    def _watch(self, patience):
        while not self.has_ended and not self.is_left:
            if not _answers(self._proxy, patience):
                words = 'its server has not answered for {} s'.format(patience)
                self._end(None, rospy.ServiceException(words))
                return
            time.sleep(1)

    def _end(self, response, error):
        if not self.has_ended:
            self._response, self._error = response, error
            self.has_ended = True
        if not self.is_left:
            self._wake.set()

    def answer(self):
        """Return the response, or raise the error of the call."""
        if self._error is not None:
            raise self._error
        return self._response


def _answers(proxy, patience):
    """Return True if the node of a service answers within some seconds.

    A response may take any time. But each node answers a probe, as `rospy.wait_for_service` sends
    it, in a thread of its own.
    """
    from rosgraph import network  # as rospy does

    probe = {
        'probe': '1',
        'md5sum': '*',
        'callerid': rospy.get_caller_id(),
        'service': proxy.resolved_name,
    }
    try:
        address = rospy.core.parse_rosrpc_uri(proxy.uri)
        with socket.create_connection(address, patience) as connection:
            network.write_ros_handshake_header(connection, probe)
            network.read_ros_handshake_header(connection, io.BytesIO(), 4096)
    except (OSError, network.ROSHandshakeException):
        return False
    return True
