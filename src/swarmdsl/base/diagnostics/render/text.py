"""Diagnostics as text for people, with excerpts."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from typing import TextIO

from swarmdsl.base.diagnostics.collector import Diagnostic, Label, Severity
from swarmdsl.base.diagnostics.render.printable import printable

_STYLES = {Severity.ERROR: "bold red", Severity.WARNING: "bold yellow"}
_FRAME = "blue"
_RELATED = "cyan"


# A piece of text and its style.
Piece = tuple[str, str]


def render(found: Iterable[Diagnostic], stream: TextIO) -> None:
    """Write the diagnostics, in colour when the stream is a terminal."""
    drawn = [list(_drawn(diagnostic)) for diagnostic in found]
    if not drawn:
        return
    if not (stream.isatty() or os.environ.get("FORCE_COLOR")):
        stream.writelines(f"{''.join(text for text, _ in pieces)}\n" for pieces in drawn)
        return
    # Imported here because it is slow and only needed for colours.
    from rich.console import Console
    from rich.text import Text

    console = Console(file=stream, highlight=False, soft_wrap=True)
    for pieces in drawn:
        # A Text is printed literally, without interpreting markup.
        console.print(Text.assemble(*pieces))


def _drawn(diagnostic: Diagnostic) -> Iterator[Piece]:
    style = _STYLES[diagnostic.severity]
    labels = [label for label in (diagnostic.primary, *diagnostic.related) if label is not None]
    gutter = max((len(str(label.span.line)) for label in labels), default=0)
    yield f"{diagnostic.severity.value}[{diagnostic.code}]", style
    yield f": {printable(diagnostic.message)}\n", "bold"
    if diagnostic.primary is not None:
        yield from place(diagnostic.primary, gutter, "^", style, diagnostic.primary.message)
    for label in diagnostic.related:
        yield "note", _RELATED
        yield f": {printable(label.message)}\n", ""
        yield from place(label, gutter, "-", _RELATED, "")
    for kind, text in _remarks(diagnostic):
        yield f"{'':{gutter}} = " if gutter else "  = ", _FRAME
        yield kind, "bold"
        yield f": {printable(text)}\n", ""


def _remarks(diagnostic: Diagnostic) -> list[tuple[str, str]]:
    remarks = [("note", note) for note in diagnostic.notes]
    if diagnostic.help is not None:
        remarks.append(("help", diagnostic.help))
    return remarks


def place(label: Label, gutter: int, mark: str, style: str, message: str) -> Iterator[Piece]:
    """Render a place: path, line, and marks; `gutter` is the width of line numbers."""
    # Imported here because most runs have no place to show.
    from swarmdsl.base.diagnostics.render.excerpt import excerpt

    source = label.span.source
    line, column = source.line_column(label.span.start)
    shown = excerpt(label.span)
    yield f"{'':{gutter}}--> ", _FRAME
    yield f"{printable(source.name)}:{line}:{column}\n", ""
    yield f"{'':{gutter}} |\n{line:>{gutter}} | ", _FRAME
    yield f"{shown.text}\n", ""
    yield f"{'':{gutter}} | ", _FRAME
    yield " " * shown.indent, ""
    yield f"{mark * shown.length} {printable(message)}".rstrip() + "\n", style
