"""Answers for whoever writes: what can stand here, new names, changes that mend something."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.format import formatted
from swarmdsl.server.completion import Completion, completions
from swarmdsl.server.connection import INVALID_PARAMS, REQUEST_FAILED, Json, RequestError
from swarmdsl.server.findings import as_findings
from swarmdsl.server.fixes import fix
from swarmdsl.server.hover import described
from swarmdsl.server.layout import line_changes
from swarmdsl.server.session import Place, Session
from swarmdsl.server.signatures import signature
from swarmdsl.server.snippets import snippets
from swarmdsl.server.words import (
    COMPLETION_KEYWORD,
    COMPLETION_KINDS,
    COMPLETION_SNIPPET,
    COMPLETION_STRUCT,
    COMPLETION_VARIABLE,
)
from swarmdsl.source import Span
from swarmdsl.workspace.renaming import RefusedError, renamable, rename

_SNIPPET = 2
CAPABILITIES: Json = {
    "completionProvider": {"triggerCharacters": [".", ">", ":", "[", "(", ",", "/"]},
    "signatureHelpProvider": {"triggerCharacters": ["(", ","], "retriggerCharacters": ["="]},
    "documentFormattingProvider": True,
    "documentRangeFormattingProvider": True,
    "renameProvider": {"prepareProvider": True},
    "codeActionProvider": {"codeActionKinds": ["quickfix"]},
}


def _completion(session: Session, params: Json) -> list[Json]:
    place = session.place(params)
    if place is None:
        return []
    fills = bool(session.offers("textDocument", "completion", "completionItem", "snippetSupport"))
    answers = []
    for index, each in enumerate(completions(*place)):
        answer: Json = {
            "label": each.word,
            "detail": each.detail,
            "kind": _completion_kind(each),
            "sortText": f"{each.node is None:d}{index:05}",
        }
        if each.node is not None:
            text = described(each.node)
            answer["documentation"] = {"kind": "markdown", "value": text}
        answers.append(answer)
        if fills and each.text is not None:
            answer |= {"insertText": each.text, "insertTextFormat": _SNIPPET}
    return [*answers, *(_snippets(place, answers) if fills else ())]


def _completion_kind(completion: Completion) -> int:
    if completion.node is not None:
        return COMPLETION_KINDS.get(type(completion.node), COMPLETION_VARIABLE)
    return COMPLETION_KEYWORD if completion.detail == "keyword" else COMPLETION_STRUCT


def _snippets(place: Place, answers: list[Json]) -> Iterator[Json]:
    """Whole statements that begin with one of the keywords that can stand here."""
    keywords = {each["label"] for each in answers if each["kind"] == COMPLETION_KEYWORD}
    for snippet in snippets(keywords, *place):
        yield {
            "label": snippet.label,
            "detail": snippet.about,
            "kind": COMPLETION_SNIPPET,
            "filterText": snippet.label,
            "insertText": snippet.text,
            "insertTextFormat": _SNIPPET,
            "sortText": f"2{snippet.label}",
        }


def _signature(session: Session, params: Json) -> Json | None:
    place = session.place(params)
    found = signature(*place) if place is not None else None
    if found is None:
        return None
    parameters = [
        {"label": [start, end], **({"documentation": doc} if doc else {})}
        for start, end, doc in found.parameters
    ]
    answer: Json = {"label": found.label, "parameters": parameters}
    # Where none is meant, one behind the last says so in all versions of the protocol.
    active = found.active if found.active is not None else len(parameters)
    return {"signatures": [answer], "activeSignature": 0, "activeParameter": active}


def _formatting(session: Session, params: Json) -> list[Json]:
    return _layout(session, params, whole=True)


def _range_formatting(session: Session, params: Json) -> list[Json]:
    return _layout(session, params, whole=False)


def _layout(session: Session, params: Json, *, whole: bool) -> list[Json]:
    """The changes that give a file, or the lines of a part of it, their layout."""
    found = session.file(params)
    if found is None:
        return []
    source = found[1].source
    text = formatted(source, Diagnostics())
    if text is None:
        return []
    within = Span(source, 0, len(source.text))
    if not whole:
        within = session.span(found[1], params.get("range"))
    document = session.documents.get(source.path) if source.path is not None else None
    crlf = document is not None and "\r\n" in document.text
    return [
        {
            "range": session.range(span),
            "newText": new.replace("\n", "\r\n") if crlf else new,
        }
        for span, new in line_changes(source, text, within)
    ]


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
    "textDocument/signatureHelp": _signature,
    "textDocument/formatting": _formatting,
    "textDocument/rangeFormatting": _range_formatting,
    "textDocument/prepareRename": _prepare_rename,
    "textDocument/rename": _rename,
    "textDocument/codeAction": _code_actions,
}
