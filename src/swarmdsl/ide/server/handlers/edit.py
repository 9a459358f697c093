"""Handlers for editing: signature help, formatting, rename, quick fixes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace.renaming import RefusedError, renamable, rename
from swarmdsl.ide.server.code_action import code_actions
from swarmdsl.ide.server.file_renames import import_changes
from swarmdsl.ide.server.layout import line_changes
from swarmdsl.ide.server.refactorings import refactorings, resolved
from swarmdsl.ide.server.session import Session
from swarmdsl.ide.server.signatures import signature
from swarmdsl.syntax.formatter import format_source


def _signature(session: Session, params: lsp.SignatureHelpParams) -> lsp.SignatureHelp | None:
    place = session.place(params.text_document, params.position)
    found = signature(*place) if place is not None else None
    if found is None:
        return None
    parameters = [
        lsp.ParameterInformation(label=(start, end), documentation=doc or None)
        for start, end, doc in found.parameters
    ]
    answer = lsp.SignatureInformation(label=found.label, parameters=parameters)
    # An index after the last parameter means "none" in all versions of the protocol.
    active = found.active if found.active is not None else len(parameters)
    return lsp.SignatureHelp(signatures=[answer], active_signature=0, active_parameter=active)


def _formatting(session: Session, params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit]:
    return _layout(session, params.text_document)


def _range_formatting(
    session: Session, params: lsp.DocumentRangeFormattingParams
) -> list[lsp.TextEdit]:
    return _layout(session, params.text_document, params.range)


def _layout(
    session: Session, document: lsp.TextDocumentIdentifier, part: lsp.Range | None = None
) -> list[lsp.TextEdit]:
    """Return the edits that format a file, or the lines of a part of it."""
    found = session.file(document)
    if found is None:
        return []
    source = found[1].source
    text = format_source(source, Diagnostics())
    if text is None:
        session.tell_once("not formatted: this file has syntax errors", source.name)
        return []
    session.told.discard(source.name)
    whole = Span(source, 0, len(source.text))
    within = whole if part is None else session.span(found[1], part)
    shown = session.documents.get(source.path) if source.path is not None else None
    crlf = shown is not None and "\r\n" in shown.text
    return [
        lsp.TextEdit(range=session.range(span), new_text=new.replace("\n", "\r\n") if crlf else new)
        for span, new in line_changes(source, text, within)
    ]


def _prepare_rename(
    session: Session, params: lsp.PrepareRenameParams
) -> lsp.PrepareRenamePlaceholder | None:
    place = session.place(params.text_document, params.position)
    if place is None:
        return None
    try:
        found = renamable(*place)
    except RefusedError as error:
        raise _failed(error) from error
    return lsp.PrepareRenamePlaceholder(
        range=session.range(found.span), placeholder=found.span.text
    )


def _rename(session: Session, params: lsp.RenameParams) -> lsp.WorkspaceEdit | None:
    place = session.place(params.text_document, params.position)
    if place is None:
        return None
    try:
        spans = rename(*place, params.new_name)
    except RefusedError as error:
        raise _failed(error) from error
    return session.workspace_edit([(span, params.new_name) for span in spans])


def _failed(error: RefusedError) -> JsonRpcException:
    return JsonRpcException(str(error), lsp.LSPErrorCodes.RequestFailed)


def _will_rename(session: Session, params: lsp.RenameFilesParams) -> lsp.WorkspaceEdit:
    moves = []
    for each in params.files:
        old, new = session.path(each.old_uri), session.path(each.new_uri)
        if old is not None and new is not None:
            moves.append((old, new))
    return session.workspace_edit(import_changes(session.models.all(), moves))


def _code_actions(session: Session, params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
    found = session.file(params.text_document)
    if found is None:
        return []
    return [*code_actions(session, *found, params), *refactorings(session, *found, params)]


def _resolve_code_action(session: Session, params: lsp.CodeAction) -> lsp.CodeAction:
    try:
        return resolved(session, params)
    except RefusedError as error:
        raise _failed(error) from error


REQUESTS: Mapping[str, Callable[[Session, Any], Any]] = {
    lsp.TEXT_DOCUMENT_SIGNATURE_HELP: _signature,
    lsp.TEXT_DOCUMENT_FORMATTING: _formatting,
    lsp.TEXT_DOCUMENT_RANGE_FORMATTING: _range_formatting,
    lsp.TEXT_DOCUMENT_PREPARE_RENAME: _prepare_rename,
    lsp.TEXT_DOCUMENT_RENAME: _rename,
    lsp.TEXT_DOCUMENT_CODE_ACTION: _code_actions,
    lsp.WORKSPACE_WILL_RENAME_FILES: _will_rename,
    lsp.CODE_ACTION_RESOLVE: _resolve_code_action,
}
