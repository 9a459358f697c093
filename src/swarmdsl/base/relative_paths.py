"""Paths below the output folder."""

from __future__ import annotations

import re
import unicodedata

# Control characters, and what Windows reads as a separator, a drive or a stream.
_FORBIDDEN = re.compile(r"[\x00-\x1f\x7f\\:]")


def stays_inside(path: str) -> bool:
    """Return True for a relative path with `/` that stays in the output folder."""
    parts = path.split("/")
    return not _FORBIDDEN.search(path) and all(part not in ("", ".", "..") for part in parts)


def clash_key(path: str) -> str:
    """Return a key that is equal for paths that a file system may not tell apart: case, Unicode."""
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", path).casefold())
