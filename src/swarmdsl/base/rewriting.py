"""Edits of files that leave every other byte as it is."""

from __future__ import annotations

import re
from collections.abc import Iterable

from swarmdsl.base.records import dataclass
from swarmdsl.base.unified_diff import unified_diff

_LINE_END = re.compile(r"\r\n|\n|\r")
_MARK = "\ufeff"

Change = tuple[int, int, str]
"""From where to where in the text of a file, as it is read, and what comes there."""


@dataclass(frozen=True)
class Layout:
    """Content of a file before and after edits."""

    name: str
    before: bytes
    after: bytes

    @property
    def changed(self) -> bool:
        """Return True if the edits change the file."""
        return self.before != self.after

    def diff(self) -> str:
        """Return the edits as a unified diff."""
        return unified_diff(self.before, self.after, self.name, self.name)


def rewritten(name: str, content: bytes, changes: Iterable[Change]) -> Layout:
    """Apply changes to a UTF-8 file; new lines end as its first one does."""
    raw = content.decode("utf-8")
    first = _LINE_END.search(raw)
    end = first[0] if first is not None else "\n"
    starts = _starts(raw)
    pieces: list[str] = []
    done = 0
    for start, stop, text in sorted(changes):
        pieces += (raw[done : starts[start]], text.replace("\n", end))
        done = starts[stop]
    return Layout(name, content, "".join((*pieces, raw[done:])).encode())


def _starts(raw: str) -> list[int]:
    """Return the offset in the file of each character of the decoded text, and of its end."""
    found = []
    at = 1 if raw.startswith(_MARK) else 0
    while at < len(raw):
        found.append(at)
        at += 2 if raw.startswith("\r\n", at) else 1
    found.append(len(raw))
    return found
