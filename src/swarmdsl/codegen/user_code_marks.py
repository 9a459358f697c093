"""Marks that tell if a file of the user fits the current model.

Such a file contains `swarmc:fits MARK`: MARK is a hash of the facts of the model that its code
relies on. After adapting the code, the user writes the new mark.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from hashlib import sha256

_MARK = re.compile(rb"swarmc:fits ([0-9a-f]{8})\b")


def mark_of(facts: Iterable[str]) -> str:
    """Return the mark of facts, one a line."""
    return sha256("\n".join(facts).encode()).hexdigest()[:8]


def fits(facts: Iterable[str]) -> str:
    """Return the line with the mark for a file that the user fills in."""
    return f"swarmc:fits {mark_of(facts)}"


def mark_in(content: bytes) -> str | None:
    """Return the mark in a file, or None."""
    found = _MARK.search(content)
    return found[1].decode() if found is not None else None


def outdated(user_file: bytes, generated: bytes, base: bytes | None) -> tuple[str, str] | None:
    """Return the mark in the user's file and the required one; None if they agree.

    If the user removed the mark, that of `base` counts, the text that the file was made from; if
    that is unknown, the mark is "".
    """
    written, required = mark_in(user_file) or mark_in(base or b"") or "", mark_in(generated)
    if required is None or written == required:
        return None
    return written, required


def marked(content: bytes, mark: str) -> bytes:
    """Return the file with another mark."""
    return _MARK.sub(f"swarmc:fits {mark}".encode(), content, count=1)
