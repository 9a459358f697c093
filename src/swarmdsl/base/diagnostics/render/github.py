"""Workflow commands of GitHub Actions, which shows them next to changed lines."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TextIO

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.base.diagnostics.render.places import relative_path
from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.base.source import Span


def render(found: Iterable[Diagnostic], stream: TextIO) -> None:
    """Write one command a diagnostic; its severities are commands there."""
    for diagnostic in found:
        properties = (
            _place(diagnostic.primary.span)
            if diagnostic.primary and not diagnostic.primary.span.on_command_line
            else {}
        )
        properties["title"] = f"{diagnostic.code} {diagnostic.name}"
        written = ",".join(f"{name}={_property(text)}" for name, text in properties.items())
        stream.write(f"::{diagnostic.severity.value} {written}::{_text(_message(diagnostic))}\n")


def _place(span: Span) -> dict[str, str]:
    line, column = span.source.line_column(span.start)
    end_line, end_column = span.source.line_column(span.end)
    place = {"file": relative_path(span.source.name), "line": line, "col": column}
    place["endLine"] = end_line
    if line == end_line:
        # Columns of two lines say nothing together, and are refused.
        place["endColumn"] = end_column
    return {name: str(value) for name, value in place.items()}


def _message(diagnostic: Diagnostic) -> str:
    lines = [diagnostic.message]
    if diagnostic.primary is not None and diagnostic.primary.message:
        lines[0] += f": {diagnostic.primary.message}"
    lines += [f"note: {note}" for note in diagnostic.notes]
    if diagnostic.help is not None:
        lines.append(f"help: {diagnostic.help}")
    return "\n".join(map(printable, lines))


def _text(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _text(text).replace(":", "%3A").replace(",", "%2C")
