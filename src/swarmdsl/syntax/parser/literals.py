"""Literals: strings, numbers and durations."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Iterator
from math import isinf

from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.syntax import units
from swarmdsl.syntax.parser.lexer import SYMBOLS, Lexer

# Nanoseconds in each unit of durations.
UNITS = {"us": 1_000, "ms": 1_000_000, "s": 10**9, "min": 60 * 10**9, "h": 3600 * 10**9}
# Longer names first: `m` begins `m/s`.
UNIT_NAMES = "|".join(sorted((name for name in units.UNITS if name != "%"), key=len, reverse=True))
# Where an operand follows, `%` is the remainder.
PERCENT_SIGN = r'%(?![ \t]*(?:(?!(?:and|or)\b|step[ \t]+[\w("-])[A-Za-z_]|[\d("]|-(?!>)))'
# Maximum of `uint64`, and of a duration in nanoseconds.
_LARGEST, _LONGEST = 2**64 - 1, 2**63 - 1
_ESCAPE = re.compile(r"\\(?:u([0-9A-Fa-f]{4})|U([0-9A-Fa-f]{8})|([^\n]))")
# Python takes long to convert longer ones.
_MOST_DIGITS = 400
# What no output in XML can contain (XML 1.0, 2.2).
_FORBIDDEN = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
_ESCAPED = {'"': '"', "\\": "\\", "n": "\n", "r": "\r", "t": "\t"}
_AS_ESCAPE = {character: f"\\{letter}" for letter, character in _ESCAPED.items()}


class Language:
    """Lexer and reserved words of a grammar."""

    def __init__(self, tokens: Lexer, reserved: Iterable[str]) -> None:
        self.tokens = tokens
        self.not_a_name = frozenset(reserved) | SYMBOLS
        self.quantity = re.compile(
            r"(\d+(?:\.\d+)?(?:[eE][+-]?\d+)?)"
            rf"(?:[ \t]*((?:{UNIT_NAMES})\b|{PERCENT_SIGN})|\b)(?!\.\d)"
        ).match


def unquoted(text: str) -> str:
    r"""Return the content of a string literal, with escapes such as `\n` and `\u2028` replaced."""
    if "\\" not in text:
        return text[1:-1]
    return _ESCAPE.sub(_escaped, text[1:-1])


def quoted(text: str) -> str:
    """Return a string literal on one line, in which no character is invisible.

    Raises ValueError for a character that no string can contain.
    """
    if text.isprintable() and '"' not in text and "\\" not in text:
        return f'"{text}"'
    if forbidden := forbidden_character(text):
        raise ValueError(f"a string cannot contain {forbidden}")
    return f'"{"".join(map(_as_escape, text))}"'


def escape_faults(text: str, start: int, end: int) -> Iterator[tuple[int, int, str, str]]:
    """Yield the start and end of wrong escapes in a piece of text, a message and a hint."""
    for found in _ESCAPE.finditer(text, start, end):
        code = found[1] or found[2]
        if code and _character(code) is None:
            reason = f"a string cannot contain U+{int(code, 16):04X}"
            yield (
                *found.span(),
                reason,
                Advice("remove it: XML cannot contain it", "remove character"),
            )
        elif found[3] in ("u", "U"):
            digits = {"u": "four", "U": "eight"}[found[3]]
            reason = f"`{found[0]}` without {digits} hexadecimal digits in a string"
            yield *found.span(), reason, "write `\\u00e9`, or `\\U0001f916`"
        elif found[3] and found[3] not in _ESCAPED:
            reason = f"unknown escape `{found[0]}` in a string"
            yield *found.span(), reason, Advice("write `\\\\` for `\\`", "escape")


def forbidden_character(text: str) -> str | None:
    """Return the first character that no string can contain, as `U+0007`; None without one."""
    found = _FORBIDDEN.search(text)
    return f"U+{ord(found[0]):04X}" if found else None


def _character(digits: str) -> str | None:
    """Return the character with a hexadecimal number; None if no string can contain it."""
    code = int(digits, 16)
    return chr(code) if code <= sys.maxunicode and not _FORBIDDEN.match(chr(code)) else None


def _escaped(found: re.Match[str]) -> str:
    code = found[1] or found[2]
    if code:
        return _character(code) or "\N{REPLACEMENT CHARACTER}"
    return _ESCAPED.get(found[3], found[3])


def _as_escape(character: str) -> str:
    if character in _AS_ESCAPE:
        return _AS_ESCAPE[character]
    if character.isprintable():
        return character
    code = ord(character)
    return f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"


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
    if unit in UNITS:
        return nanoseconds(text, unit) > _LONGEST
    if unit:
        value = units.in_unit_of_ros(digits, units.UNITS[unit])
        if isinstance(value, float):
            return isinf(value)
    return isinstance(value, int) and value > _LARGEST


def nanoseconds(text: str, unit: str) -> int:
    """Return a duration in nanoseconds, exactly; a float could be inexact."""
    digits = text.removesuffix(unit).rstrip()
    if digits.isdecimal() and len(digits) < 20:  # the most frequent case needs no import
        return int(digits) * UNITS[unit]
    from decimal import Decimal

    return round(Decimal(digits) * UNITS[unit])
