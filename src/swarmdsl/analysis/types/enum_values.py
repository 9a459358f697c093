"""Numbers of the values of enums."""

from __future__ import annotations

from swarmdsl.base.numerals import integer
from swarmdsl.syntax.ast import EnumType
from swarmdsl.syntax.types import Primitive

DEFAULT = Primitive("uint8")


def underlying(enum: EnumType) -> Primitive:
    """Return the type of the numbers, by default `uint8`."""
    type_ = enum.underlying.type if enum.underlying is not None else None
    return type_ if isinstance(type_, Primitive) else DEFAULT


def numbers(enum: EnumType) -> dict[str, int]:
    """Return the number of each value, by default one more than the number before.

    The first value of a repeated name counts.
    """
    found: dict[str, int] = {}
    number = -1
    for value in enum.values:
        number = integer(value.value) if value.value else number + 1
        found.setdefault(str(value.name), number)
    return found
