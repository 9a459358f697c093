"""Status of the node on `/diagnostics`, for tools that monitor a robot."""

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

_DEPTH = 10


class Diagnostics:
    """
    Publishes the status of a machine and its calls of functions.

    Each message has the warnings since the last one, and the missing servers; after a failure, the
    status stays an error.
    """

    def __init__(self, node, machine, member):
        self._node = node
        self._publisher = node.create_publisher(DiagnosticArray, '/diagnostics', _DEPTH)
        self._name = f'{node.get_fully_qualified_name().lstrip("/")}: {machine}'
        self._member = member or ''
        self._warnings = []
        self._failure = ''

    def warn(self, what):
        """Add a warning to the next message."""
        self._warnings.append(what)

    def fail(self, what):
        """Note the failure that has ended the machine."""
        self._failure = what.strip().rpartition('\n')[2]

    def tell(self, states, running, calls):
        """Publish a message with the states of the machine and its calls."""
        waiting = [call for call in calls if call.is_waiting]
        warnings = [*self._warnings, *(f'{call} has no server yet' for call in waiting)]
        self._warnings.clear()
        status = DiagnosticStatus(
            level=DiagnosticStatus.OK,
            name=self._name,
            message=', '.join(states) if running else 'ended',
            hardware_id=self._member,
            values=[
                KeyValue(key='states', value=', '.join(states)),
                *(KeyValue(key=str(call), value=call.progress) for call in calls),
                *(KeyValue(key='warning', value=each) for each in warnings),
            ],
        )
        if self._failure:
            status.level, status.message = DiagnosticStatus.ERROR, self._failure
        elif warnings:
            status.level, status.message = DiagnosticStatus.WARN, warnings[0]
        message = DiagnosticArray(status=[status])
        message.header.stamp = self._node.get_clock().now().to_msg()
        self._publisher.publish(message)

    def release(self):
        """Destroy the publisher."""
        self._node.destroy_publisher(self._publisher)
