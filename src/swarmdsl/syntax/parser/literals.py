"""Literals: strings, numbers and durations."""

from __future__ import annotations

import re
from collections.abc import Iterable
from math import isinf

from swarmdsl.syntax.parser.lexer import SYMBOLS, Lexer

# Nanoseconds in each unit of durations.
UNITS = {"us": 1_000, "ms": 1_000_000, "s": 10**9, "min": 60 * 10**9, "h": 3600 * 10**9}
# Maximum of `uint64`, and of a duration in nanoseconds.
_LARGEST, _LONGEST = 2**64 - 1, 2**63 - 1
_ESCAPE = r"\\(.)"
# Python takes long to convert longer ones.
_MOST_DIGITS = 400
_ESCAPED = {"n": "\n", "t": "\t"}


class Language:
    """Lexer and reserved words of a grammar."""

    def __init__(self, tokens: Lexer, reserved: Iterable[str]) -> None:
        self.tokens = tokens
        self.not_a_name = frozenset(reserved) | SYMBOLS
        self.quantity = re.compile(
            r"(\d+(?:\.\d+)?(?:[eE][+-]?\d+)?)(?:[ \t]*(us|ms|s|min|h))?\b(?!\.\d)"
        ).match


def unquoted(text: str) -> str:
    r"""Return the content of a string literal, with `\"`, `\\`, `\n` and `\t` replaced."""
    if "\\" not in text:
        return text[1:-1]
    return re.sub(_ESCAPE, lambda found: _ESCAPED.get(found[1], found[1]), text[1:-1])


def quantity_value(digits: str) -> int | float:
    """Return the value of a number literal."""
    return int(digits) if digits.isdigit() else float(digits)


def is_out_of_range(text: str, digits: str, unit: str) -> bool:
    """Return True if no type can hold a number with its unit, which may be empty."""
    if len(text) > _MOST_DIGITS:
        return True
    value = quantity_value(digits)
    if isinstance(value, float) and isinf(value):
        return True
    if unit:
        return nanoseconds(text, unit) > _LONGEST
    return isinstance(value, int) and value > _LARGEST


def nanoseconds(text: str, unit: str) -> int:
    """Return a duration in nanoseconds, exactly; a float could be inexact."""
    digits = text.removesuffix(unit).rstrip()
    if digits.isdecimal() and len(digits) < 20:  # the most frequent case needs no import
        return int(digits) * UNITS[unit]
    from decimal import Decimal

    return round(Decimal(digits) * UNITS[unit])
