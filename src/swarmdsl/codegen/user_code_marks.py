"""Whether a file of the user fits what is generated beside it.

Such a file says with `swarmc:fits MARK` what it was written for: MARK stands for all of the model
that its code builds on. The person who has adapted the code writes the new mark there.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from hashlib import sha256

_MARK = re.compile(rb"swarmc:fits ([0-9a-f]{8})\b")


def mark_of(facts: Iterable[str]) -> str:
    """The mark that stands for what code builds on, a fact a line."""
    return sha256("\n".join(facts).encode()).hexdigest()[:8]


def fits(facts: Iterable[str]) -> str:
    """What a file to fill in says of what code in it builds on: a line with the mark."""
    return f"swarmc:fits {mark_of(facts)}"


def mark_in(content: bytes) -> str | None:
    """The mark in a file, None where it has none."""
    found = _MARK.search(content)
    return found[1].decode() if found is not None else None


def outdated(of_user: bytes, generated: bytes, base: bytes | None) -> tuple[str, str] | None:
    """What the user's file is written for, as a mark, and what it should be; None where it fits.

    Where it has no mark any more, that of the text it was made from counts, `base`; of a file of
    which that is not known, "".
    """
    written, wanted = mark_in(of_user) or mark_in(base or b"") or "", mark_in(generated)
    if wanted is None or written == wanted:
        return None
    return written, wanted


def marked(content: bytes, mark: str) -> bytes:
    """The file with another mark."""
    return _MARK.sub(f"swarmc:fits {mark}".encode(), content, count=1)
