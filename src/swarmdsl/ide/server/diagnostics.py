"""Convert diagnostics into those of the protocol."""

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


def to_range(span: Span, encoding: str) -> lsp.Range:
    """Return the range of a span in its file."""
    (line, character), (end_line, end_character) = bounds(span, encoding)
    return lsp.Range(
        start=lsp.Position(line=line, character=character),
        end=lsp.Position(line=end_line, character=end_character),
    )


def to_lsp_diagnostics(
    found: Iterable[Diagnostic], encoding: str, uri: Callable[[Path], str]
) -> list[lsp.Diagnostic]:
    """Convert diagnostics of one file; `uri` maps a path to its URI."""
    return [_to_lsp_diagnostic(each, encoding, uri) for each in found]


def _to_lsp_diagnostic(
    found: Diagnostic, encoding: str, uri: Callable[[Path], str]
) -> lsp.Diagnostic:
    primary = found.primary
    label = primary.message if primary is not None else ""
    lines = [found.message, label, *found.notes, f"help: {found.help}" if found.help else ""]
    start = lsp.Position(line=0, character=0)
    return lsp.Diagnostic(
        range=to_range(primary.span, encoding) if primary else lsp.Range(start=start, end=start),
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
        uri=uri(Path(label.span.source.name)), range=to_range(label.span, encoding)
    )
    return lsp.DiagnosticRelatedInformation(location=place, message=label.message or "see here")
