"""Source files and places in them."""

# No `from __future__ import annotations`: typing would compile string annotations one by one.
from bisect import bisect_right
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

from swarmdsl.base.records import dataclass, field

COMMAND_LINE = "<command line>"
"""The name of a source that is an argument of the command line, as compilers call it."""

# To look for so many places takes less time than to find out where all lines begin.
_FEW = 16


@dataclass(eq=False)
class Source:
    """Text of a file, or an argument of the command line.

    `name` is the path as the user gave it; `path` is the file, None for other text.
    """

    name: str
    text: str
    path: Path | None = None
    _asked = 0

    @cached_property
    def line_starts(self) -> list[int]:
        """Offset of the first character of each line."""
        starts, end = [], 0
        for row in self.text.split("\n"):
            starts.append(end)
            end += len(row) + 1
        return starts

    def line_column(self, offset: int) -> tuple[int, int]:
        """Line and column of an offset, both counted from 1, columns in characters."""
        if self._asked < _FEW and "line_starts" not in vars(self):
            self._asked += 1
            before = self.text.rfind("\n", 0, offset)
            return self.text.count("\n", 0, offset) + 1, offset - before
        line = bisect_right(self.line_starts, offset)
        return line, offset - self.line_starts[line - 1] + 1

    def line_text(self, line: int) -> str:
        """Return the text of a line (counted from 1) without its end."""
        start, end = self.line_range(line)
        return self.text[start:end]

    def line_range(self, line: int) -> tuple[int, int]:
        """Offsets of a line (counted from 1) without its end. A line can be the whole file."""
        starts = self.line_starts
        start = starts[line - 1]
        end = starts[line] - 1 if line < len(starts) else len(self.text)
        while end > start and self.text[end - 1] == "\r":
            end -= 1
        return start, end


@dataclass(eq=False)
class Piece(Source):
    """Segment of a file that is parsed on its own, with its offset in the file.

    Spans in it remain valid when the text before it changes; only `whole` and `base` change.
    """

    whole: Source = field(kw_only=True)
    base: int = field(default=0, kw_only=True)

    def line_column(self, offset: int) -> tuple[int, int]:
        """Line and column of an offset, in the file."""
        return self.whole.line_column(self.base + offset)

    def line_text(self, line: int) -> str:
        """Return the text of a line of the file."""
        return self.whole.line_text(line)

    def line_range(self, line: int) -> tuple[int, int]:
        """Offsets of a line of the file, in the file."""
        return self.whole.line_range(line)


class Span(NamedTuple):
    """A piece of a source: offsets in characters, `end` exclusive."""

    source: Source
    start: int
    end: int

    @property
    def text(self) -> str:
        """The piece itself."""
        return self.source.text[self.start : self.end]

    @property
    def absolute(self) -> "Span":
        """The same place as one in the file."""
        source, start, end = self
        if not isinstance(source, Piece):
            return self
        return Span(source.whole, source.base + start, source.base + end)

    @property
    def on_command_line(self) -> bool:
        """Return True if it is in no file."""
        return self.source.name == COMMAND_LINE

    @property
    def line(self) -> int:
        """Line of the start, counted from 1."""
        return self.source.line_column(self.start)[0]
