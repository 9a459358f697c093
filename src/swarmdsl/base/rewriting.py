"""Rewritten files: edits of spans that leave every other byte as it is."""

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
    """The content of a file, as it is and as it should be."""

    name: str
    before: bytes
    after: bytes

    @property
    def changed(self) -> bool:
        """Whether it is not as it should be."""
        return self.before != self.after

    def diff(self) -> str:
        """What would change, as a unified diff."""
        return unified_diff(self.before, self.after, self.name, self.name)


def rewritten(name: str, content: bytes, changes: Iterable[Change]) -> Layout:
    """A file of UTF-8 with changes; new lines end as its first one does."""
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
    """For each character of the text as it is read, and its end, where that is in the file."""
    found = []
    at = 1 if raw.startswith(_MARK) else 0
    while at < len(raw):
        found.append(at)
        at += 2 if raw.startswith("\r\n", at) else 1
    found.append(len(raw))
    return found
