"""Interface of a node to YASMIN: make a machine, and run it."""

import yasmin
from yasmin_ros import set_ros_loggers
from yasmin_viewer import YasminViewerPub

from .parameters import Parameter

NAME = 'YASMIN'
SHOWN = Parameter('viewer.publish', 'bool', True, 'Whether yasmin_viewer is told of states.')


def make(fsm, node, is_shown):
    """Return the valid machine of a node; yasmin_viewer shows it if `is_shown`."""
    set_ros_loggers(node)
    machine = fsm.build()
    machine.validate()
    if is_shown:
        YasminViewerPub(machine, fsm.behavior.machine.name, node=node)
    return machine


def run(machine):
    """Run a machine to its end, and return the outcome."""
    return machine(yasmin.Blackboard())
