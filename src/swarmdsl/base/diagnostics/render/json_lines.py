"""One JSON object a line and diagnostic, for programs."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any, TextIO

from swarmdsl.base.diagnostics.collector import Diagnostic, Fix, Label


def render(found: Iterable[Diagnostic], stream: TextIO) -> None:
    """Write the diagnostics; lines and columns count from 1, ends are exclusive."""
    for diagnostic in found:
        stream.write(json.dumps(as_json(diagnostic)) + "\n")


def as_json(diagnostic: Diagnostic) -> dict[str, Any]:
    """Return a diagnostic as plain data."""
    return {
        **place_as_json(diagnostic.primary),
        "severity": diagnostic.severity.value,
        "code": diagnostic.code,
        "name": diagnostic.name,
        "message": diagnostic.message,
        "label": diagnostic.primary.message if diagnostic.primary else "",
        "help": diagnostic.help,
        "related": [
            {**place_as_json(label), "message": label.message} for label in diagnostic.related
        ],
        "notes": list(diagnostic.notes),
        "fixes": [_fix(fix) for fix in diagnostic.fixes],
    }


def _fix(fix: Fix) -> dict[str, Any]:
    edits = [{**place_as_json(Label(span)), "text": text} for span, text in fix.edits]
    return {"title": fix.title, "safe": fix.safe, "edits": edits}


def place_as_json(label: Label | None) -> dict[str, Any]:
    """Return a place as plain data; it has no file and no numbers if it is None."""
    if label is None:
        return dict.fromkeys(("file", "line", "column", "end_line", "end_column"))
    source, start, end = label.span
    line, column = source.line_column(start)
    end_line, end_column = source.line_column(end)
    return {
        "file": source.name,
        "line": line,
        "column": column,
        "end_line": end_line,
        "end_column": end_column,
    }
