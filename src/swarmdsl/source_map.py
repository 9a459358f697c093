"""Which place in a model each line of a generated file comes from.

While a file is made, its text carries places: `comments` of `swarmdsl.python_source` says one,
templates mark others with `at`. Printed, a place holds for its line and all that follow with
the same indentation or more, until another place is as deep; what is not marked belongs to
what stands around it, and in the end to nothing but the `origin` of the file.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

from swarmdsl.source import Span

# Characters that Unicode keeps for such use inside of programs (the noncharacters).
_MARK = re.compile("\ufdd0([0-9]+)\ufdd1")


class Entry(NamedTuple):
    """From `line` on, counted from 1, a file comes from `origin`; None where that is not known."""

    line: int
    origin: Span | None


class Placed(str):
    """A piece of a generated text that comes from a place in the model."""

    __slots__ = ("origin",)
    origin: Span | None

    def __new__(cls, text: str, origin: Span | None) -> Placed:
        """The text with its place; None ends what was said for lines as deep as this one."""
        made = super().__new__(cls, text)
        made.origin = origin
        return made


def at(origin: Span | None = None) -> Placed:
    """Nothing to print, from a place: for a template to mark a line that prints something."""
    return Placed("", origin)


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

    def rewritten(self, rewrite: Callable[[str], Sequence[str]]) -> MappedText:
        """The text with other lines in place of each one, of which there is at least one."""
        lines: list[str] = []
        starts = []
        for line in self.splitlines():
            starts.append(len(lines) + 1)
            lines += rewrite(line)
        entries = (Entry(starts[entry.line - 1], entry.origin) for entry in self.entries)
        return MappedText("\n".join([*lines, ""]), entries)


def marked(value: Placed, origins: list[Span | None]) -> str:
    """A text as a template prints it: its place leaves a mark behind, and goes to `origins`."""
    origins.append(value.origin)
    return f"{value}\ufdd0{len(origins) - 1}\ufdd1"


def mapped(text: str, origins: Sequence[Span | None]) -> MappedText:
    """A text that was printed with marks, without them."""
    if not origins:
        return MappedText(text)
    entries: list[Entry] = []
    around: list[tuple[int, Span]] = []
    lines = []
    for number, line in enumerate(text.split("\n"), 1):
        bare = _MARK.sub("", line)
        lines.append(bare)
        if not bare.strip():
            continue
        depth = len(bare) - len(bare.lstrip())
        while around and around[-1][0] > depth:
            around.pop()
        for mark in _MARK.finditer(line):
            while around and around[-1][0] >= depth:
                around.pop()
            if (origin := origins[int(mark[1])]) is not None:
                around.append((depth, origin))
        holds = around[-1][1] if around else None
        if holds is not (entries[-1].origin if entries else None):
            entries.append(Entry(number, holds))
    return MappedText("\n".join(lines), entries)
