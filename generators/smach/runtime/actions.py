"""Actions as states that end even if their servers fail.

A `smach_ros.SimpleActionState` waits forever when its server dies, does not cancel a goal when it
is preempted while sending it, and hangs the next time after a callback has failed.
"""

import threading

import rospy
from actionlib import ActionClient, CommState
from actionlib_msgs.msg import GoalStatus

from .states import Activity

# Defaults of timeouts in seconds, from the options of swarmc.
_MISSING_SERVER = 10
_DEAD_SERVER = 5
_CANCEL = 5
# Outcomes of goals by status; others are aborted.
_OUTCOMES = {
    GoalStatus.SUCCEEDED: 'succeeded',
    GoalStatus.PREEMPTED: 'preempted',
    GoalStatus.RECALLED: 'preempted',
}


class ActionState(Activity):
    """Sends a goal and waits for its result.

    `goal_cb(userdata, goal)` fills the goal or returns another one; `result_cb(userdata, status,
    result)` reads the result, and may return the outcome. Otherwise the state succeeds when the
    goal succeeds, and is preempted when the server preempts the goal. It is aborted when the goal
    ends otherwise, when the server is missing or silent, and when a callback fails or returns an
    invalid outcome.

    When the state is left, it cancels the goal, waits until the goal has ended, and ignores the
    result. ROS parameters set timeouts in seconds of ROS time: `~timeouts/missing_server` for a
    server, `~timeouts/dead_server` for a status of the goal, and `~timeouts/cancel` for the end of
    a cancelled goal.
    """

    def __init__(self, name, spec, goal=None, goal_cb=None, result_cb=None, **keywords):
        super().__init__(name, **keywords)
        self._spec = spec
        self._goal = goal
        self._goal_cb = goal_cb
        self._result_cb = result_cb
        self._client = ActionClient(name, spec)
        self._missing = _timeout('missing_server', _MISSING_SERVER)
        self._dead = _timeout('dead_server', _DEAD_SERVER)
        self._cancel = _timeout('cancel', _CANCEL)

    def call(self):
        """Return the outcome and the result of the goal."""
        goal = self._spec().action_goal.goal if self._goal is None else self._goal
        goal = self.ask(self._goal_cb, goal) or goal
        handle = self._reach(goal) if self._has_server() else None
        if handle is None:
            return 'aborted', None
        status, result = handle.get_terminal_state(), handle.get_result()
        outcome = self.ask(self._result_cb, status, result) or _OUTCOMES.get(status, 'aborted')
        return outcome, result

    def _has_server(self):
        """Wait for the server; return True if there is one."""
        since = rospy.get_rostime()
        while not self._is_connected():
            self._pause(0.02)
            if self.preempt_requested() or rospy.is_shutdown():
                return False
            if rospy.get_rostime() - since > self._missing:
                rospy.logerr('there is no server of action %s', self.name)
                return False
        return True

    def _is_connected(self):
        if rospy.get_rostime().is_zero():  # simulated time has not begun
            return False
        return self._client.wait_for_server(rospy.Duration(nsecs=-1))  # checks once

    def _reach(self, goal):
        """Send the goal and wait for its end; return its handle, None after a timeout."""
        ended = threading.Event()

        def look(handle):
            if handle.get_comm_state() == CommState.DONE:
                ended.set()
                self._wake.set()

        if self.preempt_requested():
            return None
        handle = self._client.send_goal(goal, look)
        heard, cancelled, last = rospy.get_rostime(), None, None
        while not ended.is_set() and not rospy.is_shutdown():
            now, status = rospy.get_rostime(), self._client.last_status_msg
            if status is not last and _is_known(handle, status):
                heard = now
            last = status
            if cancelled is None and self.preempt_requested():
                handle.cancel()
                cancelled = now
            if cancelled is not None and now - cancelled > self._cancel:
                rospy.logwarn('the server of action %s does not give up its goal', self.name)
                return None
            if now - heard > self._dead:
                rospy.logerr('the server of action %s is silent', self.name)
                handle.cancel()
                return None
            self._pause(0.05)
        return handle if ended.is_set() else None

    def _pause(self, seconds):
        """Wait for some seconds, or until the next change."""
        self._wake.wait(seconds)
        self._wake.clear()


def _timeout(name, default):
    return rospy.Duration(rospy.get_param('~timeouts/' + name, default))


def _is_known(handle, status):
    """Return True if a goal is in the status list of its server."""
    known = handle.comm_state_machine.action_goal.goal_id.id
    return any(each.goal_id.id == known for each in status.status_list)
