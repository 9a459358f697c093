"""Tests of node climb. This file is yours: it was written once.

swarmc:fits c132a845
"""

import demo.msg
import pytest
import rclpy
from rclpy.parameter import Parameter
from climb.implementation import Climb


@pytest.fixture
def node():
    """Create the node, with ROS in this process."""
    rclpy.init()
    needed = [
        Parameter('frame', value='map'),
    ]
    node = Climb(parameter_overrides=needed)
    yield node
    node.destroy_node()
    rclpy.shutdown()


def test_a_goal_ends(node):
    """Expect that a goal is aborted, until it is implemented."""
    assert node.execute(node.Goal()).status == 'aborted'


def test_on_state(node):
    """Expect that a message is processed."""
    node.on_state(demo.msg.Sample())
