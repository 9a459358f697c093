"""The words of expressions: names, texts, numbers and durations, as they are written."""

from __future__ import annotations

import re
from collections.abc import Iterable
from math import isinf

from swarmdsl.syntax.parser.lexer import MARKS, Cutter

# Nanoseconds in each unit of durations.
UNITS = {"us": 1_000, "ms": 1_000_000, "s": 10**9, "min": 60 * 10**9, "h": 3600 * 10**9}
# What a `uint64` holds at most, and a duration in nanoseconds.
_LARGEST, _LONGEST = 2**64 - 1, 2**63 - 1
_ESCAPE = r"\\(.)"
# More would take Python long to read, and nobody needs them.
_MOST_DIGITS = 400
_ESCAPED = {"n": "\n", "t": "\t"}


class Language:
    """The tokens and words of the language, which the grammar of files says."""

    def __init__(self, tokens: Cutter, reserved: Iterable[str]) -> None:
        self.tokens = tokens
        self.not_a_name = frozenset(reserved) | MARKS
        self.quantity = re.compile(
            r"(\d+(?:\.\d+)?(?:[eE][+-]?\d+)?)(?:[ \t]*(us|ms|s|min|h))?\b(?!\.\d)"
        ).match


def unquoted(text: str) -> str:
    r"""The content of a text in double quotes, with `\"`, `\\`, `\n` and `\t` replaced."""
    if "\\" not in text:
        return text[1:-1]
    return re.sub(_ESCAPE, lambda found: _ESCAPED.get(found[1], found[1]), text[1:-1])


def quantity_value(digits: str) -> int | float:
    """The number that is written so."""
    return int(digits) if digits.isdigit() else float(digits)


def is_too_large(text: str, digits: str, unit: str) -> bool:
    """Whether no type holds a number with its unit, which may be empty."""
    if len(text) > _MOST_DIGITS:
        return True
    value = quantity_value(digits)
    if isinstance(value, float) and isinf(value):
        return True
    if unit:
        return nanoseconds(text, unit) > _LONGEST
    return isinstance(value, int) and value > _LARGEST


def nanoseconds(text: str, unit: str) -> int:
    """The length of a duration, exactly as written, which a float may not be."""
    digits = text.removesuffix(unit).rstrip()
    if digits.isdecimal() and len(digits) < 20:  # what is said most often, without an import
        return int(digits) * UNITS[unit]
    from decimal import Decimal

    return round(Decimal(digits) * UNITS[unit])
