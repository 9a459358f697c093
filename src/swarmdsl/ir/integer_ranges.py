"""Types whose range a computed value may exceed."""

from __future__ import annotations

from swarmdsl.ir.expressions import Binary, Call, Expression, Literal, Unary
from swarmdsl.syntax.types import INTEGERS, STRING, Primitive, Type


def bound_of(value: Expression, expected: Type | None) -> str | None:
    """Return the integer or string type that a value may exceed, or None.

    Constant values are already checked, and values that are only passed on have that type.
    """
    computed = isinstance(value, (Unary, Binary, Call))
    if computed and value.type == STRING:
        return STRING.name
    if isinstance(value, Literal) or (not computed and value.type == expected):
        return None
    return bound_of_any(expected)


def bound_of_any(expected: Type | None) -> str | None:
    """Return the same for a value of unknown origin."""
    is_whole = isinstance(expected, Primitive) and expected.name in INTEGERS
    return expected.name if isinstance(expected, Primitive) and is_whole else None
