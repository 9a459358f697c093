"""Code actions: the fixes of diagnostics, one, all of a kind, or all safe ones of a file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lsprotocol import types as lsp

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.base.diagnostics.collector import Diagnostic, Fix
from swarmdsl.base.source import Span
from swarmdsl.driver.fixes import fixes_of
from swarmdsl.driver.fixes.application import fix_all, without_overlaps
from swarmdsl.driver.workspace import Workspace
from swarmdsl.ide.server.diagnostics import to_lsp_diagnostics
from swarmdsl.ide.server.features import FIX_ALL
from swarmdsl.ide.server.layout import line_changes
from swarmdsl.ide.server.session import Session
from swarmdsl.project.loader import File


def code_actions(
    session: Session, workspace: Workspace, file: File, params: lsp.CodeActionParams
) -> Iterator[lsp.CodeAction]:
    """Yield the actions at a range, of the kinds that the client asks for."""
    only = params.context.only
    if only is None or any(_includes(kind, lsp.CodeActionKind.QuickFix) for kind in only):
        yield from _quick_fixes(session, workspace, file, params.range)
    # Found only on request: all fixes are tried.
    if only is not None and any(_includes(kind, FIX_ALL) for kind in only):
        yield from _all_safe(session, workspace, file)


def _includes(kind: str, wanted: str) -> bool:
    """Return True if a kind that the client asks for is `wanted`, or one above it."""
    return wanted == str(kind) or wanted.startswith(f"{kind}.")


def _quick_fixes(
    session: Session, workspace: Workspace, file: File, part: lsp.Range
) -> Iterator[lsp.CodeAction]:
    requested = session.span(file, part)
    every = workspace.diagnostics().get(file.source.name, [])
    codes = []
    for each in every:
        span = each.primary.span if each.primary is not None else None
        if span is None or span.start > requested.end or requested.start > span.end:
            continue
        fixes = fixes_of(each, workspace)
        codes += [each.code] if fixes else []
        for number, fix in enumerate(fixes):
            yield lsp.CodeAction(
                title=fix.title,
                kind=lsp.CodeActionKind.QuickFix,
                diagnostics=to_lsp_diagnostics([each], session.encoding, session.uri),
                edit=session.workspace_edit(fix.edits),
                is_preferred=number == 0,
            )
    for code in dict.fromkeys(codes):
        # Each new name is tried on the model: many take too long.
        if code == CODES["naming-style"].code:
            continue
        alike = [each for each in every if each.code == code]
        yield from _all_of_a_kind(session, workspace, alike)


def _all_of_a_kind(
    session: Session, workspace: Workspace, alike: Sequence[Diagnostic]
) -> Iterator[lsp.CodeAction]:
    """Yield the action that applies the best fix of each diagnostic with one code."""
    proposed = ((each, fix) for each in alike for fix in fixes_of(each, workspace)[:1])
    chosen = without_overlaps(proposed)
    if len(chosen) > 1:
        edits: list[tuple[Span, str]] = []
        fixes: list[Fix] = [fix for _, fix in chosen]
        for fix in fixes:
            edits += fix.edits
        yield lsp.CodeAction(
            title=f"Fix all `{alike[0].name}` in this file ({len(chosen)})",
            kind=lsp.CodeActionKind.QuickFix,
            edit=session.workspace_edit(edits),
        )


def _all_safe(session: Session, workspace: Workspace, file: File) -> Iterator[lsp.CodeAction]:
    """Yield the action that applies all safe fixes to a file, again until nothing changes."""
    path, source = file.source.path, file.source
    if path is None:
        return
    with workspace.overriding({path: source.text}):
        text = fix_all(workspace, only=path).after.get(path)
    if text is not None:
        edits = line_changes(source, text, Span(source, 0, len(source.text)))
        yield lsp.CodeAction(
            title="Fix all that is certain", kind=FIX_ALL, edit=session.workspace_edit(edits)
        )
