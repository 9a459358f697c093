"""Answers for whoever writes: what can stand here, new names, changes that mend something."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.format import formatted
from swarmdsl.server.completion import completions
from swarmdsl.server.connection import INVALID_PARAMS, REQUEST_FAILED, Json, RequestError
from swarmdsl.server.findings import as_findings
from swarmdsl.server.fixes import fix
from swarmdsl.server.hover import described
from swarmdsl.server.session import Session
from swarmdsl.server.words import COMPLETION_KEYWORD, COMPLETION_KINDS, COMPLETION_VARIABLE
from swarmdsl.source import Span
from swarmdsl.workspace.renaming import RefusedError, renamable, rename

CAPABILITIES: Json = {
    "completionProvider": {"triggerCharacters": [".", ">", ":", "["]},
    "documentFormattingProvider": True,
    "renameProvider": {"prepareProvider": True},
    "codeActionProvider": {"codeActionKinds": ["quickfix"]},
}


def _completion(session: Session, params: Json) -> list[Json]:
    place = session.place(params)
    if place is None:
        return []
    return [
        {
            "label": each.word,
            "detail": each.detail,
            "kind": COMPLETION_KINDS.get(type(each.node), COMPLETION_VARIABLE)
            if each.node is not None
            else COMPLETION_KEYWORD,
            **(
                {"documentation": {"kind": "markdown", "value": described(each.node)}}
                if each.node is not None
                else {}
            ),
            "sortText": f"{each.node is None:d}{index:05}",
        }
        for index, each in enumerate(completions(*place))
    ]


def _formatting(session: Session, params: Json) -> list[Json]:
    found = session.file(params)
    if found is None:
        return []
    source = found[1].source
    text = formatted(source, Diagnostics())
    if text is None or text == source.text:
        return []
    document = session.documents[found[1].source.path] if found[1].source.path else None
    if document is not None and "\r\n" in document.text:
        text = text.replace("\n", "\r\n")
    return [{"range": session.range(Span(source, 0, len(source.text))), "newText": text}]


def _prepare_rename(session: Session, params: Json) -> Json | None:
    place = session.place(params)
    if place is None:
        return None
    try:
        found = renamable(*place)
    except RefusedError as error:
        raise RequestError(REQUEST_FAILED, str(error)) from error
    return {"range": session.range(found.span), "placeholder": found.span.text}


def _rename(session: Session, params: Json) -> Json | None:
    place, name = session.place(params), params.get("newName")
    if not isinstance(name, str):
        raise RequestError(INVALID_PARAMS, "the new name is missing")
    if place is None:
        return None
    try:
        spans = rename(*place, name)
    except RefusedError as error:
        raise RequestError(REQUEST_FAILED, str(error)) from error
    return {"changes": _edits(session, [(span, name) for span in spans])}


def _edits(session: Session, changes: Iterable[tuple[Span, str]]) -> Json:
    """Texts to be put in places, by file."""
    found: dict[str, list[Json]] = {}
    for span, text in changes:
        location = session.location(span)
        if location is not None:
            edit = {"range": location["range"], "newText": text}
            found.setdefault(location["uri"], []).append(edit)
    return found


def _code_actions(session: Session, params: Json) -> list[Json]:
    found = session.file(params)
    if found is None:
        return []
    workspace, file = found
    wanted = session.span(file, params.get("range"))
    actions = []
    for each in workspace.diagnostics().get(file.source.name, []):
        span = each.primary.span if each.primary is not None else None
        touched = span is not None and span.start <= wanted.end and wanted.start <= span.end
        mended = fix(each) if touched else None
        if mended is not None:
            edit = _edits(session, [(mended.span, mended.text)])
            actions.append(
                {
                    "title": mended.title,
                    "kind": "quickfix",
                    "diagnostics": as_findings([each], session.encoding, session.uri),
                    "edit": {"changes": edit},
                    "isPreferred": True,
                }
            )
    return actions


REQUESTS: Mapping[str, Callable[[Session, Json], Any]] = {
    "textDocument/completion": _completion,
    "textDocument/formatting": _formatting,
    "textDocument/prepareRename": _prepare_rename,
    "textDocument/rename": _rename,
    "textDocument/codeAction": _code_actions,
}
