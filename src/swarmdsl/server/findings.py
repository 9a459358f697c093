"""What is wrong with a file as the protocol tells it: with places, related ones, a way out."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from lsprotocol import types as lsp

from swarmdsl.diagnostics import Diagnostic, Label, Severity
from swarmdsl.explain import page_path
from swarmdsl.server.positions import bounds
from swarmdsl.source import Span

_SEVERITIES = {
    Severity.ERROR: lsp.DiagnosticSeverity.Error,
    Severity.WARNING: lsp.DiagnosticSeverity.Warning,
}
_START = lsp.Range(start=lsp.Position(line=0, character=0), end=lsp.Position(line=0, character=0))


def as_range(span: Span, encoding: str) -> lsp.Range:
    """Where a span is in its file."""
    (line, character), (end_line, end_character) = bounds(span, encoding)
    return lsp.Range(
        start=lsp.Position(line=line, character=character),
        end=lsp.Position(line=end_line, character=end_character),
    )


def as_findings(found: Iterable[Diagnostic], encoding: str) -> list[lsp.Diagnostic]:
    """Diagnostics of one file for its editor."""
    return [_finding(each, encoding) for each in found]


def _finding(found: Diagnostic, encoding: str) -> lsp.Diagnostic:
    label = found.primary.message if found.primary is not None else ""
    lines = [found.message, label, *found.notes, f"help: {found.help}" if found.help else ""]
    unused = found.name.startswith("unused")
    return lsp.Diagnostic(
        range=as_range(found.primary.span, encoding) if found.primary is not None else _START,
        severity=_SEVERITIES[found.severity],
        code=found.code,
        code_description=lsp.CodeDescription(href=page_path(found.code).as_uri()),
        source="swarmc",
        message="\n".join(filter(None, lines)),
        tags=[lsp.DiagnosticTag.Unnecessary] if unused else None,
        related_information=[_related(each, encoding) for each in found.related] or None,
    )


def _related(label: Label, encoding: str) -> lsp.DiagnosticRelatedInformation:
    path = Path(label.span.source.name).absolute()
    return lsp.DiagnosticRelatedInformation(
        location=lsp.Location(uri=path.as_uri(), range=as_range(label.span, encoding)),
        message=label.message or "see here",
    )
