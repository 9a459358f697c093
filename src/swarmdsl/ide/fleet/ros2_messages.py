"""Messages of ROS 2 by the names of their types, filled with plain data."""

from __future__ import annotations

import re
from collections.abc import Mapping
from importlib import import_module
from typing import Any

_FLOAT = re.compile(r"\b(?:float|double)\b")


def message_class(type_: str) -> Any:
    """Return the class of a type: `std_msgs/msg/String`.

    Raises ImportError, AttributeError or ValueError if there is none here.
    """
    package, kind, name = type_.split("/")
    return getattr(import_module(f"{package}.{kind}"), name)


def fill(message: Any, fields: Mapping[str, Any]) -> Any:
    """Set fields of a message, and return it; raise ValueError for those that it does not have."""
    types = message.get_fields_and_field_types()
    for name, value in fields.items():
        if name not in types:
            raise ValueError(f"the message has no field `{name}`")
        before = getattr(message, name)
        if hasattr(before, "get_fields_and_field_types"):
            if not isinstance(value, Mapping):
                raise ValueError(f"`{name}` needs an object")
            fill(before, value)
            continue
        value = _as_floats(value) if _FLOAT.search(types[name]) else value
        # Numbers are in an array of their type, which takes a list.
        is_array = isinstance(value, list) and hasattr(before, "tolist")
        if type(value) is not type(before) and not is_array:
            raise ValueError(f"`{name}` is a {types[name]}")
        try:
            setattr(message, name, value)
        except AssertionError:
            raise ValueError(f"{value} is no {types[name]}") from None
    return message


def _as_floats(value: Any) -> Any:
    """Return whole numbers as floating-point ones: JSON has one kind of numbers."""
    if isinstance(value, list):
        return [_as_floats(each) for each in value]
    return float(value) if type(value) is int else value
