"""ROS parameters of the machine, with types, ranges and documentation."""

from math import isfinite
from typing import Any, NamedTuple

from rcl_interfaces.msg import IntegerRange, ParameterDescriptor
from rclpy.exceptions import ParameterException, ParameterUninitializedException
from rclpy.parameter import Parameter as RosParameter

from .values import SECOND

_LONGEST = 2**63


class StartError(Exception):
    """The configuration does not allow the machine to start."""


class Parameter(NamedTuple):
    """
    A param of the machine; without a default, it requires a value.

    A param of type `duration` is in seconds in ROS, and in nanoseconds in the machine.
    """

    name: str
    kind: str
    default: Any = None
    doc: str = ''


def declare(node, parameters):
    """Declare parameters; raise StartError for a value of another type."""
    for each in parameters:
        given = each.default if each.default is not None else _type(each.kind)
        try:
            node.declare_parameter(each.name, given, _descriptor(each))
        except ParameterException as error:
            raise StartError(str(error)) from None


def values(node, parameters):
    """Return the values of parameters by name; raise StartError for a missing value."""
    found = {}
    for each in parameters:
        try:
            value = node.get_parameter(each.name).value
        except ParameterUninitializedException:
            value = None
        if value is None:
            raise StartError(f'parameter `{each.name}` has no value')
        if each.kind == 'duration':
            if not isfinite(value):
                raise StartError(f'parameter `{each.name}` is {value}, which is no duration')
            value = round(value * SECOND)
        found[each.name] = value
    return found


def _type(name):
    element = name.partition('[')[0]
    type_ = {
        'bool': RosParameter.Type.BOOL,
        'string': RosParameter.Type.STRING,
        'wstring': RosParameter.Type.STRING,
        'float32': RosParameter.Type.DOUBLE,
        'float64': RosParameter.Type.DOUBLE,
        'duration': RosParameter.Type.DOUBLE,
    }.get(element, RosParameter.Type.INTEGER)
    return type_ if element == name else RosParameter.Type[f'{type_.name}_ARRAY']


def _descriptor(parameter):
    """Return the descriptor of a parameter; integers have the range of their type."""
    type_ = _type(parameter.kind)
    descriptor = ParameterDescriptor(
        name=parameter.name,
        type=type_.value,
        description=parameter.doc,
        read_only=True,
    )
    if type_ is RosParameter.Type.INTEGER:
        unsigned = parameter.kind.startswith('u') or parameter.kind in ('byte', 'char')
        bits = int(parameter.kind.lstrip('uint') or 8) if 'int' in parameter.kind else 8
        lowest = 0 if unsigned else -(2 ** (bits - 1))
        greatest = min(2**bits, _LONGEST) - 1 if unsigned else 2 ** (bits - 1) - 1
        descriptor.integer_range = [IntegerRange(from_value=lowest, to_value=greatest, step=1)]
    return descriptor
