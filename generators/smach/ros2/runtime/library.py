"""Interface of a node to SMACH: make a machine, and run it."""

from smach_ros import IntrospectionServer

from .parameters import Parameter
from .states import check

NAME = 'SMACH'
SHOWN = Parameter('introspection.publish', 'bool', False, 'Whether SMACH tells its states.')


def make(fsm, node, is_shown):
    """Return the checked machine of a node; smach_viewer can show it if `is_shown`."""
    machine = fsm.build()
    check(machine)
    if is_shown:
        IntrospectionServer('smach_server', machine, f'/{fsm.behavior.machine.name}').start()
    return machine


def run(machine):
    """Run a machine to its end, and return the outcome."""
    return machine.execute()
