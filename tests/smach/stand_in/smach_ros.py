"""A stand-in for smach_ros, of which generated packages use the server for introspection only."""

import rospy

import smach

smach.set_shutdown_check(rospy.is_shutdown)


class IntrospectionServer:
    """Takes what the real one takes; nobody looks at the machine."""

    def __init__(self, server_name, state, path):
        """Know what is to be shown."""

    def start(self):
        """Show nothing."""
