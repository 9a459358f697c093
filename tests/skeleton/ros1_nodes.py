"""The nodes of the model on ROS 1, and what a client that asks them is to hear."""

from __future__ import annotations

NODES = ("climb", "beep", "camera")
# As they are made.
SKELETONS = {
    "beep": None,
    "snap": None,
    "goal": ["ABORTED", 0.0, "climb is not implemented", []],
}
# Filled in as `code` has it.
FILLED = {
    "beep": None,
    "snap": {"stored": True},
    "zoomed": {"stored": False},
    "seen": [0.5],
    "position": 7,
    "reached": ["SUCCEEDED", 1.1, "", [0.5]],
    "cancelled": ["PREEMPTED", 0.0, "left", []],
}
# Sends a goal, and does not wait for its end.
SENDER = """
import actionlib, demo.msg, rospy
rospy.init_node('sender')
client = actionlib.ActionClient('cmd/climb', demo.msg.ClimbAction)
client.wait_for_server()
sent = client.send_goal(demo.msg.ClimbGoal(height=1.0))
rospy.spin()
"""
