"""Copy messages: dictionaries and lists of values that do not change."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

_CONSTANT = frozenset((str, int, float, bool, type(None)))


def copied(value: Any) -> Any:
    """Return a copy of a message, as `deepcopy` does, but several times as fast.

    Parts are not shared in the copy, also where they are in the message.
    """
    kind = type(value)
    if kind in _CONSTANT:
        return value
    if kind is dict:
        return {
            name: part if type(part) in _CONSTANT else copied(part) for name, part in value.items()
        }
    if kind is list:
        return [part if type(part) in _CONSTANT else copied(part) for part in value]
    return deepcopy(value)
