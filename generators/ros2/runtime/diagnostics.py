"""Status of the node on `/diagnostics`, for tools that monitor a robot."""

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from .values import SECOND

_DEPTH = 10


class Diagnostics:
    """
    Publishes the status of a machine and its calls of functions.

    Each message has the warnings since the last one, the missing servers, and the number of all
    lost messages of an event; after a failure, the status stays an error.
    """

    def __init__(self, node, machine, member, losses):
        self._node = node
        self._publisher = node.create_publisher(DiagnosticArray, '/diagnostics', _DEPTH)
        self._name = f'{node.get_fully_qualified_name().lstrip("/")}: {machine}'
        self._member = member or ''
        self._warnings = []
        self._failure = ''
        self._losses = losses

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
                *(
                    KeyValue(key=f'lost messages of {event}', value=str(count))
                    for event, count in self._losses.total.items()
                ),
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


class Losses:
    """
    Counts messages that the middleware has lost; new ones are told once a second.

    `tell` gets their number of each event. Those of publishers that are not best effort are a
    warning, too. `total` has the number of each event so far.
    """

    def __init__(self, host, tell):
        self.total = {}
        self._host = host
        self._tell = tell
        self._new = {}
        self._unexpected = set()

    def add(self, event, count, is_reliable):
        """Add to the number of an event."""
        self._host.post(lambda: self._add(event, count, is_reliable))

    def _add(self, event, count, is_reliable):
        if not self._new:
            self._host.later(SECOND, self._tell_new)
        for each in (self._new, self.total):
            each[event] = each.get(event, 0) + count
        if is_reliable:
            self._unexpected.add(event)

    def _tell_new(self):
        new, self._new = self._new, {}
        said = ', '.join(f'{new[event]} of {event}' for event in sorted(self._unexpected))
        self._unexpected.clear()
        if said:
            self._host.warn(f'messages were lost: {said}')
        self._tell(new)
