"""Conversion between values of the model and messages of ROS; times are in nanoseconds."""

from array import array
from copy import deepcopy
from importlib import import_module
import math
import re

from builtin_interfaces.msg import Duration, Time

from .engine import ExecutionError

SECOND = 1_000_000_000
MILLISECOND = 1_000_000

_SEQUENCE = re.compile(r'sequence<(?P<element>.+?)(?:, (?P<bound>\d+))?>')
_ARRAY = re.compile(r'(?P<element>.+)\[(?P<size>\d+)\]')
_TEXT = re.compile(r'w?string(?:<(?P<bound>\d+)>)?')
_WHOLE = re.compile(r'(?P<unsigned>u)?int(?P<bits>\d+)')
_TIMES = {'builtin_interfaces/Duration': Duration, 'builtin_interfaces/Time': Time}
_GREATEST_FLOAT = 3.4028234663852886e38
_NOT_FINITE = ('NaN', 'Infinity', '-Infinity')
"""Numbers that JSON does not have, as strings."""


def get(message, field):
    """Return a field of a message as a value of the model."""
    try:
        value = getattr(message, field)
    except AttributeError:
        raise _missing(message, field) from None
    return plain(value)


def plain(value):
    """Return a value in a message as a value of the model."""
    if isinstance(value, (Duration, Time)):
        return value.sec * SECOND + value.nanosec
    if isinstance(value, bytes) and len(value) == 1:
        return value[0]
    return value


def put(message, field, value):
    """Store a value in a field; raise ExecutionError if it does not fit the type."""
    try:
        type_ = message.get_fields_and_field_types()[field]
    except (AttributeError, KeyError):
        raise _missing(message, field) from None
    setattr(message, field, fitted(type_, value))


def filled(message, **fields):
    """Store values in fields of a message, and return the message."""
    for field, value in fields.items():
        put(message, field, value)
    return message


def fitted(type_, value):
    """Return a copy of a value for a field of a type; raise ExecutionError if it does not fit."""
    if type_ in _TIMES:
        return _time(_TIMES[type_], value)
    if type_ in ('double', 'float'):
        if not _is_number(value) or (type_ == 'float' and _is_too_great(value)):
            raise _misfit(type_, value)
        return float(value)
    if type_ == 'boolean':
        if not isinstance(value, bool):
            raise _misfit(type_, value)
        return value
    if type_ == 'octet':
        return value if isinstance(value, bytes) else bytes([_whole(type_, value, 0, 256)])
    whole = _WHOLE.fullmatch(type_)
    if whole is not None:
        size = 1 << int(whole['bits'])
        lowest = 0 if whole['unsigned'] else -(size // 2)
        return _whole(type_, value, lowest, lowest + size)
    text = _TEXT.fullmatch(type_)
    if text is not None:
        if not isinstance(value, str) or (text['bound'] and len(value) > int(text['bound'])):
            raise _misfit(type_, value)
        return value
    many = _SEQUENCE.fullmatch(type_) or _ARRAY.fullmatch(type_)
    if many is not None:
        return _many(type_, many.groupdict(), value)
    if _name_of(type(value)) != type_:
        raise _misfit(type_, value)
    return deepcopy(value)


def from_json(message, fields):
    """Fill a message from JSON values, and return the message."""
    types = message.get_fields_and_field_types()
    for field, value in fields.items():
        if field not in types:
            raise _missing(message, field)
        put(message, field, _of_json(getattr(message, field), types[field], value))
    return message


def to_json(value):
    """Return the content of a message as plain data."""
    if isinstance(value, (Duration, Time)):
        return value.sec * SECOND + value.nanosec
    fields = getattr(value, 'get_fields_and_field_types', None)
    if fields is not None:
        return {name: to_json(getattr(value, name)) for name in fields()}
    if isinstance(value, bytes):
        return value[0] if len(value) == 1 else list(value)
    if hasattr(value, 'tolist'):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [to_json(each) for each in value]
    if isinstance(value, float) and not math.isfinite(value):
        return 'NaN' if math.isnan(value) else 'Infinity' if value > 0 else '-Infinity'
    return value


def _of_json(held, type_, value):
    """Convert JSON objects to messages and the names of numbers to these, also in lists."""
    if isinstance(value, dict):
        return from_json(held, value)
    if type_ in ('double', 'float') and value in _NOT_FINITE:
        return float(value)
    many = _SEQUENCE.fullmatch(type_) or _ARRAY.fullmatch(type_)
    if many is None or not isinstance(value, list):
        return value
    if '/' not in many['element']:
        return [_of_json(None, many['element'], each) for each in value]
    package, _, name = many['element'].partition('/')
    made = getattr(import_module(f'{package}.msg'), name)
    return [from_json(made(), each) if isinstance(each, dict) else each for each in value]


def _time(made, value):
    if isinstance(value, made):
        return value
    if not _is_number(value):
        raise _misfit('time', value)
    seconds, nanoseconds = divmod(round(value), SECOND)
    return made(sec=_whole('time', seconds, -(2**31), 2**31), nanosec=nanoseconds)


def _whole(type_, value, lowest, end):
    if isinstance(value, bool) or not isinstance(value, int) or not lowest <= value < end:
        raise _misfit(type_, value)
    return value


def _many(type_, parts, value):
    """Return an array; values from messages of ROS have their own classes, and fit."""
    is_list = isinstance(value, (list, tuple))
    if not is_list and not isinstance(value, (array, bytes)) and not hasattr(value, 'dtype'):
        raise _misfit(type_, value)
    size, bound = parts.get('size'), parts.get('bound')
    if (size and len(value) != int(size)) or (bound and len(value) > int(bound)):
        raise _misfit(type_, value)
    return [fitted(parts['element'], each) for each in value] if is_list else deepcopy(value)


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _is_too_great(value):
    return math.isfinite(value) and abs(value) > _GREATEST_FLOAT


def _name_of(class_):
    package = class_.__module__.partition('.')[0]
    return f'{package}/{class_.__name__}'


def _missing(message, field):
    return ExecutionError(f'there is no field `{field}` in a `{_name_of(type(message))}`')


def _misfit(type_, value):
    return ExecutionError(f'{value!r} is no value for a field of type `{type_}`')
