"""Asks the nodes of a graph of ROS 1 for what they offer; prints what came of it as JSON.

Run by the Python that has ROS, with what to ask: `skeletons` that are not implemented, or nodes
that are `filled` in with the code of this folder.
"""

import json
import os
import queue
import signal
import sys
import threading

import actionlib
import demo.msg
import demo.srv
import rospy
import std_msgs.msg
from actionlib.action_client import CommState
from actionlib_msgs.msg import GoalStatus

STATES = {value: name for name, value in vars(GoalStatus).items() if isinstance(value, int)}
# Sent, but without an answer of the server.
UNKNOWN = (CommState.WAITING_FOR_GOAL_ACK, CommState.PENDING)


class Client(actionlib.ActionClient):
    """A client that keeps all feedback, which may come after the result."""

    def __init__(self):
        super().__init__("cmd/climb", demo.msg.ClimbAction)
        self.feedback = queue.Queue()
        rospy.Subscriber("cmd/climb/feedback", demo.msg.ClimbActionFeedback, self.feedback.put)


def goal(client, height, feedback=0, cancel=None):
    """The state that a goal ends in, its result and text, and its feedback, at least so much."""
    began, ended = threading.Event(), threading.Event()

    def follow(handle):
        # `SimpleActionClient` is not used, because it ignores what a quick server answers before
        # `send_goal` has returned.
        if handle.get_comm_state() not in UNKNOWN:
            began.set()
        if handle.get_comm_state() == CommState.DONE:
            ended.set()

    sent = client.send_goal(demo.msg.ClimbGoal(height=height), follow)
    if cancel is not None:
        assert began.wait(60), height
        cancel(sent)
    assert ended.wait(60), height
    heard = [client.feedback.get(timeout=60).feedback.now for _ in range(feedback)]
    while not client.feedback.empty():
        heard.append(client.feedback.get().feedback.now)
    state, text = STATES[sent.get_terminal_state()], sent.get_goal_status_text()
    return [state, sent.get_result().reached, text, heard]


def ask(name, type_, **request):
    """The answer of a service, None where it gives none."""
    rospy.wait_for_service(name, 60)
    try:
        response = rospy.ServiceProxy(name, type_)(**request)
    except rospy.ServiceException:
        return None
    return {field: getattr(response, field) for field in response.__slots__}


def heard(topic, type_, publish):
    """The first message on a topic after something was published again and again."""
    came, found = threading.Event(), []
    rospy.Subscriber(topic, type_, lambda message: (found.append(message), came.set()))
    for _ in range(1200):
        publish()
        if came.wait(0.05):
            return found[0]
    return None


def main(what):
    rospy.init_node("client")
    client = Client()
    assert client.wait_for_server(rospy.Duration(20))
    if what == "stopped":
        pid = int(sys.argv[2])
        ended = goal(client, 3.0, cancel=lambda _: os.kill(pid, signal.SIGTERM))
        sys.stdout.write(json.dumps(ended) + "\n")
        return
    said = {
        "beep": ask("cmd/beep", demo.srv.Beep, times=2),
        "snap": ask("camera/snap", demo.srv.CameraSnap, zoom=1.0),
    }
    if what == "skeletons":
        said["goal"] = goal(client, 1.0)
    else:
        exposure = rospy.Publisher("exposure", std_msgs.msg.Float64, queue_size=1)
        seen = heard("target_found", demo.msg.Sample, lambda: exposure.publish(0.5))
        state = rospy.Publisher("state", demo.msg.Sample, queue_size=1, latch=True)
        state.publish(demo.msg.Sample(code=7))
        position = heard(
            "pos/goal_position", demo.msg.Sample, lambda: goal(client, 1.0, feedback=1)
        )
        said.update(
            seen=list(seen.value),
            zoomed=ask("camera/snap", demo.srv.CameraSnap, zoom=11.0),
            position=position.code,
            reached=goal(client, 1.0, feedback=1),
            raised=goal(client, 2.0),
            cancelled=goal(client, 3.0, cancel=lambda sent: sent.cancel()),
            nothing=goal(client, 4.0),
        )
        if "python" in sys.argv:
            said["wrong"] = goal(client, 5.0)
    sys.stdout.write(json.dumps(said) + "\n")


if __name__ == "__main__":
    main(sys.argv[1])
