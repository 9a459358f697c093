"""Identity of the robot of a node: `self` in the model."""

from collections import namedtuple
import re

from .parameters import Parameter

SETTINGS = (
    Parameter('member', 'string', '', 'Who this is: `uav[0]`; empty for the namespace.'),
    Parameter('self.count', 'uint32', 0, 'Members of its role; 0 for one more than its number.'),
)
# A robot: its name in the swarm, its role, its number there, and how many there are.
Identity = namedtuple('Identity', ('id', 'role', 'index', 'count'))
_IN_ROLE = re.compile(r'(.*)\[([0-9]+)\]')


def identity(settings, namespace):
    """Return the robot of a node; a part acts in the name of its robot."""
    name = (settings['member'] or namespace.strip('/')).partition('.')[0]
    in_role = _IN_ROLE.fullmatch(name)
    role, index = (in_role[1], int(in_role[2])) if in_role else ('', 0)
    return Identity(name, role, index, settings['self.count'] or index + 1)
