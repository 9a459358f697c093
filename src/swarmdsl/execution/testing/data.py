"""Partial data in tests: fields of a message, variables of a machine."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any


def given_part(fitted: Any, given: Any) -> Any:
    """Restrict a value with defaults to the given part."""
    if isinstance(given, dict) and isinstance(fitted, Mapping):
        return {key: given_part(fitted[key], each) for key, each in given.items()}
    return fitted


def matches(expected: Any, held: Any) -> bool:
    """Return True if a value matches; unnamed fields may have any value."""
    if isinstance(expected, Mapping):
        return isinstance(held, Mapping) and all(
            key in held and matches(each, held[key]) for key, each in expected.items()
        )
    if isinstance(expected, list):
        return (
            isinstance(held, list)
            and len(held) == len(expected)
            and all(map(matches, expected, held))
        )
    # In Python, True == 1.
    return isinstance(expected, bool) == isinstance(held, bool) and bool(expected == held)


def describe_fields(held: Any, names: Iterable[str]) -> str:
    """Describe the values of fields: `tries = 2, found = true`."""
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
            return f"{{ {describe_fields(value, value)} }}" if value else "{ }"
    return str(value)
