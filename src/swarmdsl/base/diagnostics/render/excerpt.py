"""Excerpt of a source line, with marks under a span, in terminal cells."""

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
    """Line of an excerpt; its marks are `length` cells from cell `indent` on."""

    text: str
    indent: int
    length: int


def excerpt(span: Span, width: int = WIDTH) -> Excerpt:
    """Return the line of the start of a span, cut to `width` cells around it.

    Marks of a longer span end with its first line; an empty span has one cell.
    """
    source, start, end = span.absolute
    text = source.text
    begin, stop = source.line_range(source.line_column(start)[0])
    first = min(start, stop)
    last = min(first + max(end - start, 0), _end_without_blanks(text, begin, stop))
    # Of a very long line only what is near can be shown: most characters take a cell or more.
    near = _NEAR * width
    parts = (
        text[max(begin, first - near) : first],
        text[first : min(last, first + near)],
        text[last : min(stop, last + near)],
    )
    before, marked, after = map(_shown, parts)
    if cell_len(before + marked + after) > width:
        before = _last_cells(before, max(_CONTEXT, width - cell_len(marked + after) - 1))
        marked = _first_cells(marked, width - cell_len(before))
        after = _first_cells(after, room) if (room := width - cell_len(before + marked)) else ""
    return Excerpt((before + marked + after).rstrip(), cell_len(before), max(cell_len(marked), 1))


def _end_without_blanks(text: str, begin: int, stop: int) -> int:
    """Return where a line ends without the blanks at its end, which are read alone."""
    size = 64
    while stop > begin:
        piece = text[max(begin, stop - size) : stop]
        blanks = len(piece) - len(piece.rstrip())
        stop -= blanks
        if blanks < len(piece):
            break
        size *= 2
    return stop


def _shown(text: str) -> str:
    return _TAB.join(map(printable, text.split("\t")))


def cell_len(text: str) -> int:
    """Return the width of a text in terminal cells."""
    if text.isascii():
        return len(text)
    # Imported here because it is slow and most models do without.
    from rich import cells

    return cells.cell_len(text)


def _first_cells(text: str, cells: int) -> str:
    """Truncate a text to a width, with an ellipsis."""
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
