"""Identity of the robot of a node: `self` in the model."""

import re
from collections import namedtuple

import rospy

# A robot: its name in the swarm, its role, its number there, and how many there are.
Identity = namedtuple('Identity', ('id', 'role', 'index', 'count'))
_IN_ROLE = re.compile(r'(.*)\[([0-9]+)\]')


def identity():
    """Return the robot of the node, by its parameters or its namespace."""
    name = rospy.get_param('~member', '') or rospy.get_namespace().strip('/')
    in_role = _IN_ROLE.fullmatch(name)
    role, index = (in_role.group(1), int(in_role.group(2))) if in_role else ('', 0)
    return Identity(name, role, index, rospy.get_param('~self/count', 0) or index + 1)
