"""Tests of node climb. This file is yours: it was written once.

swarmc:fits d3397568
"""

import unittest

import demo.msg
from climb.implementation import Climb


class TestClimb(unittest.TestCase):
    """Tests of the node without a ROS master."""

    def test_a_goal_ends(self):
        outcome = Climb().execute(Climb.Goal())

        self.assertEqual(outcome.status, 'aborted')  # until it is implemented

    def test_on_state(self):
        Climb().on_state(demo.msg.Sample())


if __name__ == '__main__':
    unittest.main()
