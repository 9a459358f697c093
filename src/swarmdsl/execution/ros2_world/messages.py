"""Messages of ROS 2 from plain data, and back; times are in nanoseconds."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from swarmdsl.execution.simulate.scenario.durations import SECOND

_TIMES = ("builtin_interfaces/Time", "builtin_interfaces/Duration")
_LIST = re.compile(r"sequence<(?P<item>.+?)(?:, \d+)?>|(?P<element>.+)\[\d+\]")


def fill(message: Any, values: Mapping[str, Any], made: Any) -> Any:
    """Store plain data in a message of ROS, and return it.

    What the message has no field for is left out. `made(type)` returns an empty message.
    """
    for name, type_ in message.get_fields_and_field_types().items():
        if name in values:
            setattr(message, name, _value(getattr(message, name), type_, values[name], made))
    return message


def plain(value: Any) -> Any:
    """Return the content of a message of ROS as plain data."""
    fields = getattr(value, "get_fields_and_field_types", None)
    if fields is not None:
        names = fields()
        if set(names) == {"sec", "nanosec"}:
            return value.sec * SECOND + value.nanosec
        return {name: plain(getattr(value, name)) for name in names}
    if isinstance(value, bytes):
        return value[0] if len(value) == 1 else list(value)
    if hasattr(value, "tolist"):
        value = value.tolist()
    return [plain(each) for each in value] if isinstance(value, (list, tuple)) else value


def _value(held: Any, type_: str, value: Any, made: Any) -> Any:
    if type_ in _TIMES and isinstance(value, (int, float)):
        held.sec, held.nanosec = divmod(round(value), SECOND)
        return held
    if isinstance(value, Mapping):
        return fill(held, value, made)
    if type_ in ("double", "float"):
        return float(value)
    if type_ == "octet" and isinstance(value, int):
        return bytes([value])
    many = _LIST.fullmatch(type_)
    if many is not None and isinstance(value, (list, tuple)):
        item = many["item"] or many["element"]
        return [_value(made(item) if "/" in item else None, item, each, made) for each in value]
    return value
