"""Conversion between offsets and positions of the protocol.

Source: LSP 3.17, "Position". Lines and characters count from 0, characters in code units of the
encoding: UTF-16 unless client and server agree on another.
"""

from __future__ import annotations

from swarmdsl.base.source import Source, Span

UTF_16 = "utf-16"

Position = tuple[int, int]


def position(source: Source, offset: int, encoding: str = UTF_16) -> Position:
    """Return line and character of an offset."""
    line, column = source.line_column(offset)
    if source.text.isascii():  # known without reading it, and a line can be long
        return line - 1, column - 1
    return line - 1, units(source.text[offset - column + 1 : offset], encoding)


def bounds(span: Span, encoding: str = UTF_16) -> tuple[Position, Position]:
    """Return the start and end positions of a span in its file."""
    source, start, end = span.absolute
    return position(source, start, encoding), position(source, end, encoding)


def offset(source: Source, at: Position, encoding: str = UTF_16) -> int:
    """Return the offset of a position, clamped to its line and to the text."""
    line, character = at
    if line < 0:
        return 0
    if line >= len(source.line_starts):
        return len(source.text)
    start, end = source.line_range(line + 1)
    if encoding == "utf-32" or source.text.isascii():
        return min(start + max(character, 0), end)
    text = source.text[start:end]
    if text.isascii():
        return start + min(max(character, 0), len(text))
    count = 0
    for index, each in enumerate(text):
        if count >= character:
            return start + index
        count += units(each, encoding)
    return start + len(text)


def units(text: str, encoding: str) -> int:
    """Return the length of a string in code units of an encoding."""
    if encoding == "utf-32" or text.isascii():
        return len(text)
    if encoding == "utf-8":
        return len(text.encode("utf-8", "surrogatepass"))
    return len(text) + sum(each > "\uffff" for each in text)
