"""Which place in a model each line of a generated file comes from.

While a file is made, its text carries places: names of what the model declares are printed as
`Placed`, templates mark other lines with `at`. Such a place holds for its line and for deeper
ones right below. A comment that says where something comes from, as `comments` of
`swarmdsl.codegen.python` makes them, holds for all that is as deep as it, until another place is
as deep. What is not marked belongs to what stands around it, and in the end to nothing but the
`origin` of the file.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

from swarmdsl.base.source import Span

# Characters that Unicode keeps for such use inside of programs (the noncharacters).
_MARK = re.compile("\ufdd0([0-9]+)\ufdd1")


class Entry(NamedTuple):
    """From `line` on, counted from 1, a file comes from `origin`; None where that is not known."""

    line: int
    origin: Span | None


class TracedStr(str):
    """A piece of a generated text that comes from a place in the model.

    `holds` says that what follows does so too.
    """

    __slots__ = ("holds", "origin")
    origin: Span | None
    holds: bool

    def __new__(cls, text: str, origin: Span | None, *, holds: bool = False) -> TracedStr:
        """The text with its place; None ends what holds for lines as deep as this one."""
        made = super().__new__(cls, text)
        made.origin = origin
        made.holds = holds
        return made


def at(origin: Span | None = None) -> TracedStr:
    """Nothing to print, from a place: for a template to mark a line that prints something."""
    return TracedStr("", origin)


class MappedText(str):
    """The text of a file that knows where its lines come from.

    As any `str`, what is made of it by methods of `str` knows nothing of that.
    """

    __slots__ = ("entries",)
    entries: tuple[Entry, ...]

    def __new__(cls, text: str, entries: Iterable[Entry] = ()) -> MappedText:
        """The text, with a table in the order of its lines."""
        made = super().__new__(cls, text)
        made.entries = tuple(entries)
        return made

    def rewritten(self, width: int, rewrite: Callable[[str], Sequence[str]]) -> MappedText:
        """The text with others in place of each line that is too wide, at least one."""
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
    """A text as a template prints it: its place leaves a mark behind, and goes to `printed`."""
    printed.append(text)
    return f"{text}\ufdd0{len(printed) - 1}\ufdd1"


def mapped(text: str, printed: Sequence[TracedStr]) -> MappedText:
    """A text that was printed with marks, without them."""
    if not printed:
        return MappedText(text)
    entries: list[Entry] = []
    # Places, from the outermost on, each with the least depth of the lines that it holds for.
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
