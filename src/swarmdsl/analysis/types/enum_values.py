"""The numbers behind the values of enums."""

from __future__ import annotations

from swarmdsl.syntax.ast import EnumType
from swarmdsl.syntax.types import Primitive

DEFAULT = Primitive("uint8")


def underlying(enum: EnumType) -> Primitive:
    """The type of the numbers: as written, or `uint8`."""
    type_ = enum.underlying.type if enum.underlying is not None else None
    return type_ if isinstance(type_, Primitive) else DEFAULT


def numbers(enum: EnumType) -> dict[str, int]:
    """The number of each value: as written, or one more than that of the value before.

    Of two values with one name, which is reported, the first counts.
    """
    found: dict[str, int] = {}
    number = -1
    for value in enum.values:
        number = int(value.value) if value.value else number + 1
        found.setdefault(str(value.name), number)
    return found
