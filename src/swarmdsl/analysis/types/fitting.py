"""Compatibility of types."""

from __future__ import annotations

from swarmdsl.syntax.types import FLOATS, INTEGERS, Array, Primitive, Type

_NUMBERS = {*INTEGERS, *FLOATS, "byte", "char"}
_RANGES = {
    name: range(2**bits) if name.startswith("u") else range(-(2 ** (bits - 1)), 2 ** (bits - 1))
    for name in INTEGERS
    for bits in (int(name.lstrip("uint")),)
}


def fits(found: Type | None, expected: Type | None) -> bool:
    """Return True if a value of type `found` can be used as `expected`."""
    if found is None or expected is None or found is expected or found == expected:
        return True
    if isinstance(found, Array) and isinstance(expected, Array):
        if expected.size is None or (expected.bounded and found.size is not None):
            enough = expected.size is None or (found.size or 0) <= expected.size
        else:
            enough = expected.size == found.size and not found.bounded
        return enough and fits(found.element, expected.element)
    if (
        isinstance(found, Primitive)
        and isinstance(expected, Primitive)
        and found.name == expected.name
    ):
        return True  # strings of different bounds
    if is_number(found) and is_number(expected):
        return is_float(expected) or not is_float(found)
    return False


def is_text(type_: Type | None) -> bool:
    """Return True for a string type with or without a bound."""
    return isinstance(type_, Primitive) and type_.name in ("string", "wstring")


def is_number(type_: Type | None) -> bool:
    """Return True for an integer or floating-point type."""
    return isinstance(type_, Primitive) and type_.name in _NUMBERS


def is_float(type_: Type | None) -> bool:
    """Return True for a floating-point type."""
    return isinstance(type_, Primitive) and type_.name in FLOATS


def range_of(type_: Type | None) -> range | None:
    """Return the range of an integer type; None for other types."""
    return _RANGES.get(type_.name) if isinstance(type_, Primitive) else None
