"""What is wrong with a file as the protocol tells it: with places, related ones, a way out."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from swarmdsl.diagnostics import Diagnostic, Label, Severity
from swarmdsl.explain import page_path
from swarmdsl.server.connection import Json
from swarmdsl.server.positions import bounds
from swarmdsl.source import Span

_SEVERITIES = {Severity.ERROR: 1, Severity.WARNING: 2}
_UNNECESSARY = 1
_START = {"start": {"line": 0, "character": 0}, "end": {"line": 0, "character": 0}}


def as_range(span: Span, encoding: str) -> Json:
    """Where a span is in its file."""
    (line, character), (end_line, end_character) = bounds(span, encoding)
    return {
        "start": {"line": line, "character": character},
        "end": {"line": end_line, "character": end_character},
    }


def as_findings(
    found: Iterable[Diagnostic], encoding: str, uri: Callable[[Path], str]
) -> list[Json]:
    """Diagnostics of one file for its editor; `uri` says how that names a file."""
    return [_finding(each, encoding, uri) for each in found]


def _finding(found: Diagnostic, encoding: str, uri: Callable[[Path], str]) -> Json:
    label = found.primary.message if found.primary is not None else ""
    lines = [found.message, label, *found.notes, f"help: {found.help}" if found.help else ""]
    finding: Json = {
        "range": as_range(found.primary.span, encoding) if found.primary is not None else _START,
        "severity": _SEVERITIES[found.severity],
        "code": found.code,
        "codeDescription": {"href": page_path(found.code).as_uri()},
        "source": "swarmc",
        "message": "\n".join(filter(None, lines)),
    }
    if found.name.startswith("unused"):
        finding["tags"] = [_UNNECESSARY]
    if found.related:
        finding["relatedInformation"] = [_related(each, encoding, uri) for each in found.related]
    return finding


def _related(label: Label, encoding: str, uri: Callable[[Path], str]) -> Json:
    return {
        "location": {
            "uri": uri(Path(label.span.source.name)),
            "range": as_range(label.span, encoding),
        },
        "message": label.message or "see here",
    }
