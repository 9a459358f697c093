"""Changes to the text of a file that leave all else in it as it is."""

from __future__ import annotations

import re

from swarmdsl.base.source import Source, Span

_ONLY_COMMENTS = re.compile(r"[ \t]*(?:/\*(?:[^*\n]|\*(?!/))*\*/[ \t]*)*(?://[^\n]*)?")


class Edits:
    """Edits of one file, applied by `text`."""

    def __init__(self, source: Source) -> None:
        self.source = source
        # Start, end, True to go after other edits at the same offset, and the new string.
        self._made: list[tuple[int, int, bool, str]] = []

    def __bool__(self) -> bool:
        return bool(self._made)

    def replace(self, place: Span, text: str) -> None:
        """Replace a span."""
        self._made.append((place.start, place.end, False, text))

    def insert(self, at: int, text: str) -> None:
        """Insert a string at an offset."""
        self._made.append((at, at, False, text))

    def above(self, at: int, lines: str) -> None:
        """Insert lines above the statement at an offset."""
        start = self.source.text.rfind("\n", 0, at) + 1
        alone = not self.source.text[start:at].strip()
        self.insert(at, f"{lines}\n" if alone else f"\n{lines}\n")

    def below(self, at: int, lines: str) -> None:
        """Insert lines below the statement that ends at an offset, and its trailing comments."""
        found = _ONLY_COMMENTS.match(self.source.text, at)
        assert found is not None  # it matches even nothing
        ends = self.source.text[found.end() : found.end() + 1] in ("\n", "")
        place = found.end() if ends else at
        self._made.append((place, place, True, f"\n{lines}" if ends else f"\n{lines}\n"))

    def changes(self) -> list[tuple[int, int, str]]:
        """Return start, end and new string of each edit, in the order of the file."""
        made = sorted(self._made, key=lambda edit: edit[:3])
        return [(start, end, text) for start, end, _, text in made]

    def text(self) -> str:
        """Return the text of the file with all edits."""
        pieces: list[str] = []
        done = 0
        for start, end, text in self.changes():
            assert start >= done, "two changes of the same text"
            pieces += (self.source.text[done:start], text)
            done = end
        return "".join((*pieces, self.source.text[done:]))
