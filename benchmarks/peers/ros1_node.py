"""Handwritten node with the behaviour of the model in `benchmarks/ros1.py`.

It runs with the Python of ROS 1.
"""

import actionlib
import rospy
from lab.msg import MoveAction, MoveGoal
from std_msgs.msg import Empty


class Work:
    """Reports its state, moves on the first message and stops on the second one."""

    def __init__(self):
        self.moves = False
        self.said = rospy.Publisher("said", Empty, queue_size=10)
        self.client = actionlib.SimpleActionClient("move", MoveAction)
        self.client.wait_for_server()
        rospy.Subscriber("go", Empty, self.hear)

    def hear(self, message):
        """Handle a message."""
        self.moves = not self.moves
        if self.moves:
            self.said.publish(Empty())
            self.client.send_goal(MoveGoal(x=1.0))
        else:
            self.client.cancel_goal()


rospy.init_node("work")
Work()
rospy.spin()
