"""Offsets in a text as the positions of the protocol, and back.

Sources: LSP 3.17, "Position": lines and characters count from 0, characters in the units of an
encoding, which is UTF-16 unless client and server agree on another.
"""

from __future__ import annotations

from swarmdsl.base.source import Source, Span

UTF_16 = "utf-16"

Position = tuple[int, int]


def position(source: Source, offset: int, encoding: str = UTF_16) -> Position:
    """Line and character of an offset."""
    line, column = source.line_column(offset)
    return line - 1, units(source.text[offset - column + 1 : offset], encoding)


def bounds(span: Span, encoding: str = UTF_16) -> tuple[Position, Position]:
    """Where a span begins and ends in its file."""
    source, start, end = span.absolute
    return position(source, start, encoding), position(source, end, encoding)


def offset(source: Source, at: Position, encoding: str = UTF_16) -> int:
    """The offset of a position; of one behind the end of its line or of the text, that end."""
    line, character = at
    if line < 0:
        return 0
    if line >= len(source.line_starts):
        return len(source.text)
    start = source.line_starts[line]
    text = source.line_text(line + 1)
    if encoding == "utf-32" or text.isascii():
        return start + min(max(character, 0), len(text))
    count = 0
    for index, each in enumerate(text):
        if count >= character:
            return start + index
        count += units(each, encoding)
    return start + len(text)


def units(text: str, encoding: str) -> int:
    """How many characters a text has, as an encoding counts them."""
    if encoding == "utf-32" or text.isascii():
        return len(text)
    if encoding == "utf-8":
        return len(text.encode("utf-8", "surrogatepass"))
    return len(text) + sum(each > "\uffff" for each in text)
