"""Compatibility of types."""

from __future__ import annotations

from swarmdsl.syntax.types import FLOATS, INTEGERS, Array, Primitive, Type

_NUMBERS = {*INTEGERS, *FLOATS, "byte", "char"}
_RANGES = {
    name: range(2**bits) if name.startswith("u") else range(-(2 ** (bits - 1)), 2 ** (bits - 1))
    for name in INTEGERS
    for bits in (int(name.lstrip("uint")),)
}


def fits(found: Type | None, wanted: Type | None) -> bool:
    """Return True if a value of type `found` can be used as `wanted`."""
    if found is None or wanted is None or found is wanted or found == wanted:
        return True
    if isinstance(found, Array) and isinstance(wanted, Array):
        if wanted.size is None or (wanted.bounded and found.size is not None):
            enough = wanted.size is None or (found.size or 0) <= wanted.size
        else:
            enough = wanted.size == found.size and not found.bounded
        return enough and fits(found.element, wanted.element)
    if isinstance(found, Primitive) and isinstance(wanted, Primitive) and found.name == wanted.name:
        return True  # strings of different bounds
    if is_number(found) and is_number(wanted):
        return is_float(wanted) or not is_float(found)
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
