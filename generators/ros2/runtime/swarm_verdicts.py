"""Verdicts on properties and values of measures, told to people and tools."""

import json

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

from .parameters import StartError
from .property_monitors import FALSE, OPEN
from .swarm_measures import Measures
from .swarm_watch import properties_of
from .values import MILLISECOND, SECOND

_DEPTH = 10
_SHOWN = 4
"""Number of lines shown with a violation."""
_HISTORY = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Verdicts:
    """
    Tells verdicts on `/diagnostics`, on a topic of the node, in its log, and in its trace.

    Measures are told likewise, on a topic of their own.

    The trace also has the lines of the robots, as they were judged. `lines` has what the verdicts
    depend on.
    """

    def __init__(self, node, swarm, lines, path):
        self._node = node
        self._lines = lines
        self._namespace = node.get_namespace()
        self._name = f'{node.get_fully_qualified_name().lstrip("/")}: {{}}'
        properties = (*swarm.properties, *properties_of(swarm.machines))
        self._found = {each.name: (each, OPEN) for each in properties}
        self._violations = {each.name: [] for each in properties}
        self._fitness = swarm.fitness
        self._measures = Measures(node, swarm, lines) if swarm.measures else None
        self._remarks = {}
        self._diagnostics = node.create_publisher(DiagnosticArray, '/diagnostics', _DEPTH)
        self._verdicts = node.create_publisher(String, '~/verdicts', _HISTORY)
        try:
            self._file = open(path, 'w', encoding='utf-8') if path else None
        except OSError as error:
            raise StartError(f'the trace cannot be written: {error}') from None

    def record(self, line):
        """Write a line of a robot to the trace."""
        self._write(line.record)

    def note(self, property_, verdict, time):
        """Tell a verdict, and the time from which on it holds."""
        self._found[property_.name] = property_, verdict
        line = {
            't': time // MILLISECOND,
            'began': self._lines.zero,
            'property': property_.name,
            'verdict': verdict,
            'violations': [
                {'robot': each.robot, 't': each.time // MILLISECOND}
                for each in self._violations[property_.name]
            ],
            'conditions': list(self._lines.conditions()),
        }
        if self._remarks.get(property_.name):
            line['remark'] = self._remarks[property_.name]
        self._verdicts.publish(String(data=_as_json(line)))
        self._write(line)

    def violated(self, violation):
        """Log a violation, with the lines before it."""
        property_ = violation.property
        self._violations[property_.name].append(violation)
        said = [
            f'property {property_.name} is violated {_by(violation)}: {property_.origin}',
            *(f'before: {_line(line)}' for line in violation.last[-_SHOWN:]),
            *(f'but {each}' for each in self._lines.conditions()),
        ]
        # Each line of source has a severity of its own in rclpy.
        if property_.chance is None:
            self._node.get_logger().error('\n'.join(said))
        else:
            self._node.get_logger().warning('\n'.join(said))

    def finish(self, results, readings, time):
        """Tell the verdicts and the values of measures at the end."""
        if self._measures is not None:
            self._write(self._measures.tell(readings, time, final=True))
            said = self._measures.said(list(self._lines.conditions()))
            self._node.get_logger().info(f'{self._fitness}: {said}')
        for result in results:
            self._remarks[result.property.name] = result.remark
            self.note(result.property, result.verdict, time)
            self._node.get_logger().info(f'{result.property.name}: {self._said(result.property)}')
        self.tell()

    def measure(self, readings, time):
        """Tell the values of measures so far, None before the beginning."""
        if self._measures is not None and readings is not None:
            self._measures.tell(readings, time)

    def tell(self):
        """Publish verdicts and measures so far on `/diagnostics`."""
        message = DiagnosticArray(status=[self._status(each) for each, _ in self._found.values()])
        if self._measures is not None:
            name = self._name.format(self._fitness)
            message.status.append(self._measures.status(name, self._namespace))
        message.header.stamp = self._node.get_clock().now().to_msg()
        self._diagnostics.publish(message)

    def release(self):
        """Destroy the publishers, and close the file."""
        self._node.destroy_publisher(self._diagnostics)
        self._node.destroy_publisher(self._verdicts)
        if self._measures is not None:
            self._measures.release()
        if self._file is not None:
            self._file.close()

    def _status(self, property_):
        _, verdict = self._found[property_.name]
        conditions = list(self._lines.conditions())
        level = DiagnosticStatus.WARN if conditions else DiagnosticStatus.OK
        if verdict == FALSE:
            by_chance = property_.chance is not None
            level = DiagnosticStatus.WARN if by_chance else DiagnosticStatus.ERROR
        return DiagnosticStatus(
            level=level,
            name=self._name.format(property_.name),
            message=self._said(property_),
            hardware_id=self._namespace,
            values=[
                KeyValue(key='property', value=property_.origin),
                KeyValue(key='verdict', value=verdict),
                *(
                    KeyValue(key='violated', value=_by(each))
                    for each in self._violations[property_.name]
                ),
                *(KeyValue(key='condition', value=each) for each in conditions),
            ],
        )

    def _said(self, property_):
        """Return the verdict on a property with its conditions: `true, but ...`."""
        _, verdict = self._found[property_.name]
        by_chance = verdict == FALSE and property_.chance is not None
        said = ['false in this run' if by_chance else str(verdict)]
        said += [_by(each) for each in self._violations[property_.name][:1]]
        remark = self._remarks.get(property_.name)
        conditions = ', '.join([*([remark] if remark else []), *self._lines.conditions()])
        return ' '.join(said) + (f', but {conditions}' if conditions else '')

    def _write(self, line):
        if self._file is not None:
            self._file.write(_as_json(line) + '\n')
            self._file.flush()


def _by(violation):
    """Return who violated a property, and when: `by uav[1] at 12.5 s`."""
    who = f'by {violation.robot} ' if violation.robot is not None else ''
    return f'{who}at {violation.time / SECOND:g} s'


def _line(line):
    """Return a line for people: `12.5 s uav[1] Found -> Searching`."""
    what = line.event or 'start'
    where = ', '.join(line.configuration)
    return f'{line.time / SECOND:g} s {line.actor.name} {what} -> {where}'


_as_json = json.JSONEncoder(ensure_ascii=False).encode
