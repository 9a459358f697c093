"""Options that are lengths in metres."""

from __future__ import annotations

import re

_LENGTH = re.compile(r"[0-9]{1,6}(\.[0-9]{1,6})?")


def length_fault(value: str) -> str | None:
    """Return the error in a length, such as `0.05`, or None."""
    if _LENGTH.fullmatch(value) and float(value) > 0:
        return None
    return f"`{value}` is not a length in m: expected a number above 0, such as `0.05`"


def optional_length_fault(value: str) -> str | None:
    """Return the error in a length that may be left out, or None."""
    return length_fault(value) if value else None
