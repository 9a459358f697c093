"""A stand-in for smach_ros: its action and service states, on whatever rospy there is."""

from __future__ import annotations

import threading

import rospy
from actionlib.simple_action_client import GoalStatus, SimpleActionClient

import smach


class _RosState(smach.State):
    def __init__(self, input_keys, output_keys, outcomes):
        super().__init__(["succeeded", "aborted", "preempted", *outcomes], input_keys, output_keys)

    def _call(self, callback, userdata, *arguments):
        keys = (self.get_registered_input_keys(), self.get_registered_output_keys())
        return callback(smach.Remapper(_Flat(userdata), *keys), *arguments)


class _Flat:
    """Userdata behind a second remapper, as smach_ros passes it to callbacks."""

    def __init__(self, userdata):
        self._userdata = userdata

    def __getitem__(self, key):
        return self._userdata[key]

    def __setitem__(self, key, value):
        self._userdata[key] = value

    def __contains__(self, key):
        return key in self._userdata


class SimpleActionState(_RosState):
    def __init__(
        self,
        name,
        spec,
        goal=None,
        goal_cb=None,
        result_cb=None,
        input_keys=(),
        output_keys=(),
        outcomes=(),
    ):
        super().__init__(input_keys, output_keys, outcomes)
        self._goal = spec().action_goal.goal if goal is None else goal
        self._goal_cb, self._result_cb = goal_cb, result_cb
        self._client = SimpleActionClient(name, spec)
        self._done = threading.Event()
        self._active = False

    def request_preempt(self):
        super().request_preempt()
        if self._active:
            self._client.cancel_goal()

    def execute(self, userdata):
        self._client.wait_for_server(rospy.Duration(1.0))
        if self.preempt_requested():
            self.service_preempt()
            return "preempted"
        goal = self._goal
        if self._goal_cb is not None:
            goal = self._call(self._goal_cb, userdata, goal)
        ended = []
        self._done.clear()
        self._active = True
        self._client.send_goal(
            goal,
            lambda status, result: (ended.append((status, result)), self._done.set()),
            lambda: None,
            lambda feedback: None,
        )
        self._done.wait()
        self._active = False
        ((status, result),) = ended
        chosen = None
        if self._result_cb is not None:
            chosen = self._call(self._result_cb, userdata, status, result)
        if chosen is not None:
            return chosen
        if status == GoalStatus.SUCCEEDED:
            return "succeeded"
        if status == GoalStatus.PREEMPTED and self.preempt_requested():
            self.service_preempt()
            return "preempted"
        return "aborted"


class ServiceState(_RosState):
    def __init__(
        self,
        name,
        spec,
        request=None,
        request_cb=None,
        response_cb=None,
        input_keys=(),
        output_keys=(),
        outcomes=(),
    ):
        super().__init__(input_keys, output_keys, outcomes)
        self._request = spec._request_class() if request is None else request
        self._request_cb, self._response_cb = request_cb, response_cb
        self._proxy = rospy.ServiceProxy(name, spec)

    def execute(self, userdata):
        if self.preempt_requested():
            self.service_preempt()
            return "preempted"
        request = self._request
        if self._request_cb is not None:
            request = self._call(self._request_cb, userdata, request)
        try:
            response = self._proxy(request)
        except rospy.ServiceException:
            return "aborted"
        if self._response_cb is not None:
            self._call(self._response_cb, userdata, response)
        return "succeeded"


def set_preempt_handler(container):
    rospy.core.add_client_shutdown_hook(container.request_preempt)
