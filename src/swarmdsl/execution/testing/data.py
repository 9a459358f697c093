"""Data that a test names in part: fields of a message, variables of a machine."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any


def only(fitted: Any, given: Any) -> Any:
    """Of a value that was filled up with defaults, what was given."""
    if isinstance(given, dict) and isinstance(fitted, Mapping):
        return {key: only(fitted[key], each) for key, each in given.items()}
    return fitted


def agrees(expected: Any, held: Any) -> bool:
    """Whether a value is the expected one; fields that are not named may be anything."""
    if isinstance(expected, Mapping):
        return isinstance(held, Mapping) and all(
            key in held and agrees(each, held[key]) for key, each in expected.items()
        )
    if isinstance(expected, list):
        return (
            isinstance(held, list)
            and len(held) == len(expected)
            and all(map(agrees, expected, held))
        )
    # To Python, true is 1.
    return isinstance(expected, bool) == isinstance(held, bool) and bool(expected == held)


def told(held: Any, names: Iterable[str]) -> str:
    """What some fields hold, in words: `tries = 2, found = true`."""
    fields = held if isinstance(held, Mapping) else {}
    return ", ".join(f"{name} = {_shown(fields.get(name))}" for name in names)


def _shown(value: Any) -> str:
    match value:
        case None:
            return "nothing"
        case bool():
            return str(value).lower()
        case str():
            return f'"{value}"'
        case list():
            return f"[{', '.join(map(_shown, value))}]"
        case Mapping():
            return f"{{ {told(value, value)} }}" if value else "{ }"
    return str(value)
