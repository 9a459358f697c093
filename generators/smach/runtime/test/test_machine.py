#!/usr/bin/env python3
"""Rostest of one state machine, without its servers.

It checks that the machine is consistent, runs, and ends soon after it is stopped. `~machine` is
the name of its module.
"""

import importlib
import sys
import threading
import unittest

import rospy
import rostest

# Package under test, from swarmc.
PACKAGE = ''


class TestMachine(unittest.TestCase):
    """The machine with the params of this node."""

    def setUp(self):
        """Build the machine."""
        name = rospy.get_param('~machine')
        self.machine = importlib.import_module(PACKAGE + '.' + name).build()

    def test_it_is_complete(self):
        """Each outcome of each state is bound."""
        check(self.machine)

    def test_it_stops(self):
        """The machine runs and ends when it is preempted, if it has not ended by itself."""
        ended = []
        runner = threading.Thread(target=lambda: ended.append(self.machine.execute()), daemon=True)
        runner.start()
        runner.join(1.0)
        self.machine.request_preempt()
        runner.join(5.0)
        self.assertEqual(len(ended), 1)
        self.assertIn(ended[0], self.machine.get_registered_outcomes())


def check(container):
    """Check a container and all containers inside for consistency."""
    container.check_consistency()
    for child in container.get_children().values():
        if hasattr(child, 'get_children'):
            check(child)


if __name__ == '__main__':
    rospy.init_node('test_machine')
    rostest.rosrun(PACKAGE, rospy.get_param('~machine'), TestMachine, sys.argv)
