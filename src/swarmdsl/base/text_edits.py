"""Changes to the text of a file that leave all else in it as it is."""

from __future__ import annotations

import re

from swarmdsl.base.source import Source, Span

_ONLY_COMMENTS = re.compile(r"[ \t]*(?:/\*(?:[^*\n]|\*(?!/))*\*/[ \t]*)*(?://[^\n]*)?")


class Edits:
    """What is to be changed in one file; nothing happens before `text` is asked for."""

    def __init__(self, source: Source) -> None:
        self.source = source
        # From where to where, whether it goes behind others that go there too, and the new text.
        self._made: list[tuple[int, int, bool, str]] = []

    def __bool__(self) -> bool:
        return bool(self._made)

    def replace(self, place: Span, text: str) -> None:
        """Put a text in the place of another."""
        self._made.append((place.start, place.end, False, text))

    def insert(self, at: int, text: str) -> None:
        """Put a text in at an offset."""
        self._made.append((at, at, False, text))

    def above(self, at: int, lines: str) -> None:
        """Put lines above what begins at an offset."""
        start = self.source.text.rfind("\n", 0, at) + 1
        alone = not self.source.text[start:at].strip()
        self.insert(at, f"{lines}\n" if alone else f"\n{lines}\n")

    def below(self, at: int, lines: str) -> None:
        """Put lines below what ends at an offset, and below the comments behind it."""
        found = _ONLY_COMMENTS.match(self.source.text, at)
        assert found is not None  # it matches even nothing
        ends = self.source.text[found.end() : found.end() + 1] in ("\n", "")
        place = found.end() if ends else at
        self._made.append((place, place, True, f"\n{lines}" if ends else f"\n{lines}\n"))

    def changes(self) -> list[tuple[int, int, str]]:
        """From where to where, and the new text, in the order of the file."""
        made = sorted(self._made, key=lambda edit: edit[:3])
        return [(start, end, text) for start, end, _, text in made]

    def text(self) -> str:
        """The text of the file with all changes."""
        pieces: list[str] = []
        done = 0
        for start, end, text in self.changes():
            assert start >= done, "two changes of the same text"
            pieces += (self.source.text[done:start], text)
            done = end
        return "".join((*pieces, self.source.text[done:]))
