"""Diagnostics for people: the line, the place under it, what to know and what to do."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TextIO

from rich.console import Console
from rich.text import Text

from swarmdsl.diagnostics import Diagnostic, Label, Severity
from swarmdsl.render.excerpt import excerpt
from swarmdsl.render.printable import printable

_STYLES = {Severity.ERROR: "bold red", Severity.WARNING: "bold yellow"}
_FRAME = "blue"
_RELATED = "cyan"


def render(found: Iterable[Diagnostic], stream: TextIO) -> None:
    """Write the diagnostics, in colour when the stream is a terminal."""
    console = Console(file=stream, highlight=False, soft_wrap=True)
    for diagnostic in found:
        # A Text is printed as it is: what looks like markup in a model stays text.
        console.print(_drawn(diagnostic))


def _drawn(diagnostic: Diagnostic) -> Text:
    style = _STYLES[diagnostic.severity]
    labels = [label for label in (diagnostic.primary, *diagnostic.related) if label is not None]
    gutter = max((len(str(label.span.line)) for label in labels), default=0)
    drawn = Text()
    drawn.append(f"{diagnostic.severity.value}[{diagnostic.code}]", style)
    drawn.append(f": {printable(diagnostic.message)}\n", "bold")
    if diagnostic.primary is not None:
        _draw_place(drawn, diagnostic.primary, gutter, "^", style, diagnostic.primary.message)
    for label in diagnostic.related:
        drawn.append("note", _RELATED).append(f": {printable(label.message)}\n")
        _draw_place(drawn, label, gutter, "-", _RELATED, "")
    for kind, text in _remarks(diagnostic):
        drawn.append(f"{'':{gutter}} = " if gutter else "  = ", _FRAME)
        drawn.append(kind, "bold").append(f": {printable(text)}\n")
    return drawn


def _remarks(diagnostic: Diagnostic) -> list[tuple[str, str]]:
    remarks = [("note", note) for note in diagnostic.notes]
    if diagnostic.help is not None:
        remarks.append(("help", diagnostic.help))
    return remarks


def _draw_place(
    drawn: Text, label: Label, gutter: int, mark: str, style: str, message: str
) -> None:
    source = label.span.source
    line, column = source.line_column(label.span.start)
    shown = excerpt(label.span)
    drawn.append(f"{'':{gutter}}--> ", _FRAME)
    drawn.append(f"{printable(source.name)}:{line}:{column}\n")
    drawn.append(f"{'':{gutter}} |\n", _FRAME)
    drawn.append(f"{line:>{gutter}} | ", _FRAME).append(f"{shown.text}\n")
    drawn.append(f"{'':{gutter}} | ", _FRAME).append(" " * shown.indent)
    drawn.append(mark * shown.length, style)
    drawn.append(f" {printable(message)}\n" if message else "\n", style)
