"""What a node asks of SMACH: to make its machine, and to run it."""

from smach_ros import IntrospectionServer

from .parameters import Parameter
from .states import check

NAME = 'SMACH'
SHOWN = Parameter('introspection.publish', 'bool', False, 'Whether SMACH tells its states.')


def make(fsm, node, is_shown):
    """Return the machine of a node, which is complete; its states may be told."""
    machine = fsm.build()
    check(machine)
    if is_shown:
        IntrospectionServer('smach_server', machine, f'/{fsm.behavior.machine.name}').start()
    return machine


def run(machine):
    """Run a machine to its end, and return the outcome."""
    return machine.execute()
