"""Messages of ROS 2 by the names of their types, filled with plain data."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import Any


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
        # JSON has one kind of numbers.
        is_whole = isinstance(before, float) and type(value) is int
        if type(value) is not type(before) and not is_whole:
            raise ValueError(f"`{name}` is a {types[name]}")
        try:
            setattr(message, name, float(value) if is_whole else value)
        except AssertionError:
            raise ValueError(f"{value} is no {types[name]}") from None
    return message
