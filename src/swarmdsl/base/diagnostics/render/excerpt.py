"""The line of a source around a span, and where under it the marks go, in terminal cells."""

from __future__ import annotations

from typing import NamedTuple

from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.base.source import Span

WIDTH = 120
_TAB = "    "
_CONTEXT = 30
_ELLIPSIS = "…"
_NEAR = 4


class Excerpt(NamedTuple):
    """A line to show; the marks are `length` cells from cell `indent` on."""

    text: str
    indent: int
    length: int


def excerpt(span: Span, width: int = WIDTH) -> Excerpt:
    """The line where the span starts, cut to `width` cells around it.

    A span of several lines is marked to the end of its first one, an empty span with
    one cell.
    """
    line, column = span.source.line_column(span.start)
    text = span.source.line_text(line)
    first = min(column - 1, len(text))
    last = min(first + max(span.end - span.start, 0), len(text.rstrip()))
    # Of a very long line only what is near can be shown: most characters take a cell or more.
    near = _NEAR * width
    parts = (
        text[max(0, first - near) : first],
        text[first : min(last, first + near)],
        text[last : last + near],
    )
    before, marked, after = ("".join(map(_shown, part)) for part in parts)
    if cell_len(before + marked + after) > width:
        before = _last_cells(before, max(_CONTEXT, width - cell_len(marked + after) - 1))
        marked = _first_cells(marked, width - cell_len(before))
        after = _first_cells(after, room) if (room := width - cell_len(before + marked)) else ""
    return Excerpt((before + marked + after).rstrip(), cell_len(before), max(cell_len(marked), 1))


def _shown(character: str) -> str:
    return _TAB if character == "\t" else printable(character)


def cell_len(text: str) -> int:
    """How many cells of a terminal a text takes."""
    if text.isascii():
        return len(text)
    # Imported here because it is slow and most models do without.
    from rich import cells

    return cells.cell_len(text)


def _first_cells(text: str, cells: int) -> str:
    """As much of the start of a text as fits, with an ellipsis for the rest."""
    if cell_len(text) <= cells:
        return text
    kept, used = [], 1
    for character in text:
        used += cell_len(character)
        if used > cells:
            break
        kept.append(character)
    return "".join(kept) + _ELLIPSIS


def _last_cells(text: str, cells: int) -> str:
    if cell_len(text) <= cells:
        return text
    return _first_cells(text[::-1], cells)[::-1]
