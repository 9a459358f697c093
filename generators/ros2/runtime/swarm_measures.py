"""Measures of a swarm, the inputs of its fitness, told to people and tools."""

import json
from typing import Any, NamedTuple

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

from .engine import bounded, ExecutionError
from .values import MILLISECOND, SECOND

_LAST = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Input(NamedTuple):
    """
    Input of a fitness: its measure, the integer type that bounds it, and its unit.

    `origin` is the measure in the model. A measure with a unit is a time.
    """

    measure: Any
    origin: str
    bound: str = ''
    unit: str = ''


class Measures:
    """Tells the values of measures on a topic of the node; `lines` has what they depend on."""

    def __init__(self, node, swarm, lines):
        self._node = node
        self._lines = lines
        self._fitness = swarm.fitness
        self._inputs = swarm.measures
        self._publisher = node.create_publisher(String, '~/measures', _LAST)
        self._found = []

    def tell(self, readings, time, *, final=False):
        """Publish the values at a time, and return the line of JSON for the trace."""
        self._found = [_record(*each) for each in zip(self._inputs, readings, strict=True)]
        line = {
            't': time // MILLISECOND,
            'began': self._lines.zero,
            'fitness': self._fitness,
            'measures': self._found,
            'conditions': list(self._lines.conditions()),
            'final': final,
        }
        self._publisher.publish(String(data=_as_json(line)))
        return line

    def said(self, conditions):
        """Return the values with their conditions: `found 3, searched 12.5 s, but ...`."""
        values = ', '.join(map(_said, self._found)) or 'not begun'
        return values + (f', but {", ".join(conditions)}' if conditions else '')

    def status(self, name, namespace):
        """Return the status of the measures for `/diagnostics`."""
        conditions = list(self._lines.conditions())
        faults = any('fault' in each for each in self._found)
        level = DiagnosticStatus.WARN if conditions or faults else DiagnosticStatus.OK
        return DiagnosticStatus(
            level=level,
            name=name,
            message=self.said(conditions),
            hardware_id=namespace,
            values=[
                *(KeyValue(key=each['name'], value=_value(each)) for each in self._found),
                *(KeyValue(key='condition', value=each) for each in conditions),
            ],
        )

    def release(self):
        """Destroy the publisher."""
        self._node.destroy_publisher(self._publisher)


def _record(each, reading):
    """Return a value as in the results of `swarmc simulate`; times are in seconds."""
    found = {'name': each.measure.name, 'value': reading.value}
    if each.unit:
        found['unit'] = each.unit
        if reading.value is not None:
            found['value'] = reading.value / SECOND
    if not reading.reached:
        found['reached'] = False
    if reading.value is None:
        found['fault'] = 'it has no value, because there is no robot'
    elif each.bound:
        try:
            bounded(reading.value, each.bound)
        except ExecutionError as error:
            found['fault'] = str(error)
    return found


def _value(record):
    value = '-' if record['value'] is None else f'{record["value"]:.6g}'
    notes = [] if record.get('reached', True) else ['not reached']
    notes += [record['fault']] if 'fault' in record else []
    unit = f' {record["unit"]}' if 'unit' in record and record['value'] is not None else ''
    return f'{value}{unit}' + (f' ({", ".join(notes)})' if notes else '')


def _said(record):
    return f'{record["name"]} {_value(record)}'


_as_json = json.JSONEncoder(ensure_ascii=False).encode
