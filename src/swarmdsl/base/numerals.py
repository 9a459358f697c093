"""Numbers that strangers write: of any length, while Python converts some thousand digits."""

from __future__ import annotations

import math

_MOST_DIGITS = 40
_TOO_LARGE: int = 10**_MOST_DIGITS


def integer(digits: str) -> int:
    """Return the value of decimal digits, at most 10^40, which is too large for every use."""
    if len(digits) <= _MOST_DIGITS:
        return int(digits)
    significant = digits.lstrip("0")
    return int(significant or "0") if len(significant) <= _MOST_DIGITS else _TOO_LARGE


def fits_64_bits(value: float) -> bool:
    """Return True for a number that a model can have: finite, and a whole one of 64 bits."""
    return math.isfinite(value) if isinstance(value, float) else -(2**63) <= value < 2**64
