"""What is wrong with a file as the protocol tells it: with places, related ones, a way out."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from lsprotocol import types as lsp

from swarmdsl.base.diagnostics.collector import Diagnostic, Label, Severity
from swarmdsl.base.diagnostics.explain import page_path
from swarmdsl.base.source import Span
from swarmdsl.ide.server.positions import bounds

_SEVERITIES = {
    Severity.ERROR: lsp.DiagnosticSeverity.Error,
    Severity.WARNING: lsp.DiagnosticSeverity.Warning,
}


def as_range(span: Span, encoding: str) -> lsp.Range:
    """Where a span is in its file."""
    (line, character), (end_line, end_character) = bounds(span, encoding)
    return lsp.Range(
        start=lsp.Position(line=line, character=character),
        end=lsp.Position(line=end_line, character=end_character),
    )


def as_findings(
    found: Iterable[Diagnostic], encoding: str, uri: Callable[[Path], str]
) -> list[lsp.Diagnostic]:
    """Diagnostics of one file for its editor; `uri` says how that names a file."""
    return [_finding(each, encoding, uri) for each in found]


def _finding(found: Diagnostic, encoding: str, uri: Callable[[Path], str]) -> lsp.Diagnostic:
    primary = found.primary
    label = primary.message if primary is not None else ""
    lines = [found.message, label, *found.notes, f"help: {found.help}" if found.help else ""]
    start = lsp.Position(line=0, character=0)
    return lsp.Diagnostic(
        range=as_range(primary.span, encoding) if primary else lsp.Range(start=start, end=start),
        severity=_SEVERITIES[found.severity],
        code=found.code,
        code_description=lsp.CodeDescription(href=page_path(found.code).as_uri()),
        source="swarmc",
        message="\n".join(filter(None, lines)),
        tags=[lsp.DiagnosticTag.Unnecessary] if found.name.startswith("unused") else None,
        related_information=[_related(each, encoding, uri) for each in found.related] or None,
    )


def _related(
    label: Label, encoding: str, uri: Callable[[Path], str]
) -> lsp.DiagnosticRelatedInformation:
    place = lsp.Location(
        uri=uri(Path(label.span.source.name)), range=as_range(label.span, encoding)
    )
    return lsp.DiagnosticRelatedInformation(location=place, message=label.message or "see here")
