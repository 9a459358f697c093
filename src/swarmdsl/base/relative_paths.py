"""Which paths may be written below the output folder, and which of them are the same file."""

from __future__ import annotations

import re
import unicodedata

# Control characters, and what Windows reads as a separator, a drive or a stream.
_FORBIDDEN = re.compile(r"[\x00-\x1f\x7f\\:]")


def stays_inside(path: str) -> bool:
    """Whether it is a relative path with `/` that cannot lead out of the output folder."""
    parts = path.split("/")
    return not _FORBIDDEN.search(path) and all(part not in ("", ".", "..") for part in parts)


def clash_key(path: str) -> str:
    """The same for two paths that some file systems take for one (case, Unicode form)."""
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", path).casefold())
