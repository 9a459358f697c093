"""Origins in the model of the lines of generated files.

While a file is made, its text carries origins: names that the model declares are printed as
`TracedStr`, templates mark other lines with `at`. Such an origin applies to its line and to deeper
lines right below. The comment that names an origin, as `comments` of `swarmdsl.codegen.python`
makes it, applies to all lines of its depth or deeper, until another origin of that depth. Unmarked
lines belong to the enclosing origin, and at last to the `origin` of the file.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

from swarmdsl.base.source import Span

# Unicode reserves these noncharacters for internal use in programs.
_MARK = re.compile("\ufdd0([0-9]+)\ufdd1")


class Entry(NamedTuple):
    """From `line` on, counted from 1, lines come from `origin`; None if unknown."""

    line: int
    origin: Span | None


class TracedStr(str):
    """String of a generated text with its origin in the model.

    `holds` says that following lines have that origin, too.
    """

    __slots__ = ("holds", "origin")
    origin: Span | None
    holds: bool

    def __new__(cls, text: str, origin: Span | None, *, holds: bool = False) -> TracedStr:
        """Attach an origin; None ends one that holds for lines of this depth."""
        made = super().__new__(cls, text)
        made.origin = origin
        made.holds = holds
        return made

    # A string needs one argument.
    def __getnewargs__(self) -> tuple[str, Span | None]:  # type: ignore[override]
        """Return the arguments for a copy; `holds` follows."""
        return str(self), self.origin


def at(origin: Span | None = None) -> TracedStr:
    """Return an empty string with an origin, with which a template marks its line."""
    return TracedStr("", origin)


class MappedText(str):
    """Text of a file, with the origins of its lines.

    Methods of `str` return strings without origins.
    """

    __slots__ = ("entries",)
    entries: tuple[Entry, ...]

    def __new__(cls, text: str, entries: Iterable[Entry] = ()) -> MappedText:
        """Attach a table in the order of the lines."""
        made = super().__new__(cls, text)
        made.entries = tuple(entries)
        return made

    def rewritten(self, width: int, rewrite: Callable[[str], Sequence[str]]) -> MappedText:
        """Return the text with each line that is too wide replaced by others."""
        lines: list[str] = []
        starts = []
        for line in self.splitlines():
            starts.append(len(lines) + 1)
            if len(line) > width:
                lines += rewrite(line)
            else:
                lines.append(line)
        entries = (Entry(starts[entry.line - 1], entry.origin) for entry in self.entries)
        return MappedText("\n".join([*lines, ""]), entries)


def marked(text: TracedStr, printed: list[TracedStr]) -> str:
    """Return the string with a mark that stands for it, and append it to `printed`."""
    printed.append(text)
    return f"{text}\ufdd0{len(printed) - 1}\ufdd1"


def mapped(text: str, printed: Sequence[TracedStr]) -> MappedText:
    """Return a text that was printed with marks as text with origins."""
    if not printed:
        return MappedText(text)
    entries: list[Entry] = []
    # Enclosing origins, outermost first, each with the least depth of its lines.
    around: list[tuple[int, Span]] = []
    lines = []
    for number, line in enumerate(text.split("\n"), 1):
        marks = _MARK.findall(line) if "\ufdd0" in line else ()
        bare = _MARK.sub("", line) if marks else line
        lines.append(bare)
        content = bare.lstrip()
        if not content:
            continue
        depth = len(bare) - len(content)
        while around and around[-1][0] > depth:
            around.pop()
        for mark in marks:
            place = printed[int(mark)]
            least = depth if place.holds or place.origin is None else depth + 1
            while around and around[-1][0] >= least:
                around.pop()
            if place.origin is not None:
                around.append((least, place.origin))
        origin = around[-1][1] if around else None
        if origin is not (entries[-1].origin if entries else None):
            entries.append(Entry(number, origin))
    return MappedText("\n".join(lines), entries)
