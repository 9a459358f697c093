"""Stand-in for module `library`, which each library has: its interface."""

from .parameters import Parameter

NAME = ''
"""Name of the library in messages."""
SHOWN = Parameter('', 'bool', False, '')
"""Parameter that makes nodes show the states of the machine in a viewer."""


def make(fsm, node, is_shown):
    """Return the machine of a node, after the library has checked it."""
    raise NotImplementedError


def run(machine):
    """Run a machine to its end, and return the outcome."""
    raise NotImplementedError
