"""Compatibility of types."""

from __future__ import annotations

from math import inf

from swarmdsl.analysis.types.constant_folding import Folded
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.syntax.ast import ExpressionTree
from swarmdsl.syntax.types import DURATION, FLOATS, INTEGERS, Array, Primitive, Type

_NUMBERS = {*INTEGERS, *FLOATS, "byte", "char"}
_RANGES = {
    name: range(2**bits) if name.startswith("u") else range(-(2 ** (bits - 1)), 2 ** (bits - 1))
    for name in INTEGERS
    for bits in (int(name.lstrip("uint")),)
}
_FLOAT32 = Primitive("float32")
_LONGEST = 2**31 * 10**9
"""Limit of a duration in ROS 1 and ROS 2, in nanoseconds (exclusive)."""
_LARGEST_FLOAT32 = (2 - 2**-23) * 2.0**127


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


def check_size(
    tree: ExpressionTree, value: Folded, expected: Type | None, report: Diagnostics
) -> None:
    """Report a constant that is too large for its type."""
    found, help_ = f"`{value}`", None
    match value:
        case bool():
            return
        case int() if (possible := range_of(expected)) is not None and value not in possible:
            help_ = f"it is a number from {possible[0]} to {possible[-1]}"
        case int() | float() if expected == DURATION:
            if -_LONGEST <= value < _LONGEST:
                return
            found = f"`{value / 1e9:.12g} s`"
            help_ = f"ROS counts its seconds in an `int32`: they are {2**31 - 1} at most"
        case int() | float() if abs(value) > _LARGEST_FLOAT32 and expected == _FLOAT32:
            help_ = "larger numbers need a `float64`"
        case str() if isinstance(expected, Primitive) and len(value) > (expected.bound or inf):
            found = f"a string of {len(value)} characters"
        case _:
            return
    report.report("type-mismatch", tree.span, expected=f"`{expected}`", found=found, help=help_)
