"""Text safe for terminals, without control characters."""

from __future__ import annotations

import unicodedata

# Control and invisible characters (escape sequences, changes of writing direction),
# and what ends a line.
_UNSAFE = frozenset({"Cc", "Cf", "Cs", "Zl", "Zp"})
_STAND_IN = "\N{REPLACEMENT CHARACTER}"


def printable(text: str) -> str:
    """Replace unprintable characters and line breaks."""
    if text.isprintable():
        return text
    return "".join(
        _STAND_IN if unicodedata.category(character) in _UNSAFE else character for character in text
    )
