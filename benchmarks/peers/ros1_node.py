"""A node as people write it by hand, which does what the one of `benchmarks/ros1.py` does.

It runs with the Python that has ROS 1.
"""

import actionlib
import rospy
from lab.msg import MoveAction, MoveGoal
from std_msgs.msg import Empty


class Work:
    """Says so and moves when it is told to go, and stops when it is told again."""

    def __init__(self):
        self.moves = False
        self.said = rospy.Publisher("said", Empty, queue_size=10)
        self.client = actionlib.SimpleActionClient("move", MoveAction)
        self.client.wait_for_server()
        rospy.Subscriber("go", Empty, self.hear)

    def hear(self, message):
        """Go on."""
        self.moves = not self.moves
        if self.moves:
            self.said.publish(Empty())
            self.client.send_goal(MoveGoal(x=1.0))
        else:
            self.client.cancel_goal()


rospy.init_node("work")
Work()
rospy.spin()
