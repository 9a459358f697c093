"""Where a value may be too large for what it is stored in."""

from __future__ import annotations

from swarmdsl.ir.expressions import Binary, Call, Expression, Literal, Unary
from swarmdsl.syntax.types import INTEGERS, STRING, Primitive, Type


def bound_of(value: Expression, wanted: Type | None) -> str | None:
    """The type, of whole numbers or text, whose bounds a value may exceed; None where it cannot.

    What is known in advance was checked, and what is only handed on is of the type it has.
    """
    computed = isinstance(value, (Unary, Binary, Call))
    if computed and value.type == STRING:
        return STRING.name
    if isinstance(value, Literal) or (not computed and value.type == wanted):
        return None
    return bound_of_any(wanted)


def bound_of_any(wanted: Type | None) -> str | None:
    """The same for a value of which nothing is known."""
    is_whole = isinstance(wanted, Primitive) and wanted.name in INTEGERS
    return wanted.name if isinstance(wanted, Primitive) and is_whole else None
