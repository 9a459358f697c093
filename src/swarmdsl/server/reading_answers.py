"""Answers about one file for whoever reads it: what a name is, the outline, colours, hints."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from swarmdsl.server import symbols
from swarmdsl.server.connection import INVALID_PARAMS, Json, RequestError
from swarmdsl.server.folds import folds
from swarmdsl.server.hints import hints
from swarmdsl.server.hover import hover
from swarmdsl.server.lenses import lenses
from swarmdsl.server.links import links
from swarmdsl.server.selections import selections
from swarmdsl.server.session import Session
from swarmdsl.server.tokens import MODIFIERS, TYPES, changes, encoded
from swarmdsl.server.words import SYMBOL_KINDS, SYMBOL_OBJECT
from swarmdsl.source import Span
from swarmdsl.workspace.occurrences import occurrence_at, occurrences_of

CAPABILITIES: Json = {
    "hoverProvider": True,
    "documentSymbolProvider": True,
    "foldingRangeProvider": True,
    "selectionRangeProvider": True,
    "inlayHintProvider": True,
    "documentLinkProvider": {},
    "codeLensProvider": {"resolveProvider": True},
    "semanticTokensProvider": {
        "legend": {"tokenTypes": TYPES, "tokenModifiers": MODIFIERS},
        "full": {"delta": True},
        "range": True,
    },
}
_HINT_KINDS = {"type": 1, "parameter": 2}


def _hover(session: Session, params: Json) -> Json | None:
    place = session.place(params)
    found = hover(*place) if place is not None else None
    if found is None:
        return None
    span, text = found
    return {"contents": {"kind": "markdown", "value": text}, "range": session.range(span)}


def _document_symbols(session: Session, params: Json) -> list[Json]:
    found = session.file(params)
    if found is None:
        return []
    return [_as_symbol(each, session) for each in symbols.outline(found[1])]


def _as_symbol(symbol: symbols.Symbol, session: Session) -> Json:
    return {
        "name": symbol.name,
        "detail": symbol.detail,
        "kind": SYMBOL_KINDS.get(symbol.kind, SYMBOL_OBJECT),
        "range": session.range(symbol.span),
        "selectionRange": session.range(symbol.selection),
        "children": [_as_symbol(each, session) for each in symbol.inside],
    }


def _tokens(session: Session, params: Json) -> Json | None:
    found = session.file(params)
    if found is None:
        return None
    data = encoded(session.painter.tokens(*found), found[1], session.encoding)
    return {"resultId": session.painter.remember(found[1].source.name, data), "data": data}


def _token_changes(session: Session, params: Json) -> Json | None:
    found = session.file(params)
    if found is None:
        return None
    name = found[1].source.name
    before = session.painter.remembered(name, params.get("previousResultId"))
    answer = _tokens(session, params)
    if before is None or answer is None:
        return answer
    edits = [
        {"start": start, "deleteCount": count, "data": data}
        for start, count, data in changes(before, answer["data"])
    ]
    return {"resultId": answer["resultId"], "edits": edits}


def _tokens_in_range(session: Session, params: Json) -> Json | None:
    found = session.file(params)
    if found is None:
        return None
    within = session.span(found[1], params.get("range"))
    tokens = session.painter.tokens(*found, within)
    return {"data": encoded(tokens, found[1], session.encoding)}


def _folds(session: Session, params: Json) -> list[Json]:
    found = session.file(params)
    return [
        {
            "startLine": each.first,
            "endLine": each.last,
            **({"kind": each.kind} if each.kind else {}),
        }
        for each in (folds(found[1].source) if found is not None else ())
    ]


def _selections(session: Session, params: Json) -> list[Json]:
    found, positions = session.file(params), params.get("positions")
    if not isinstance(positions, list):
        raise RequestError(INVALID_PARAMS, "the positions are missing")
    if found is None:
        return []
    answers = []
    for at in positions:
        answer: Json = {}
        for span in reversed(selections(found[1], session.offset(found[1], at))):
            answer = {"range": session.range(span), **({"parent": answer} if answer else {})}
        answers.append(answer)
    return answers


def _hints(session: Session, params: Json) -> list[Json]:
    found = session.file(params)
    if found is None:
        return []
    file = found[1]
    answers = []
    for hint in hints(file, session.span(file, params.get("range"))):
        answer: Json = {
            "position": session.range(Span(file.source, hint.offset, hint.offset))["start"],
            "label": hint.text,
            "tooltip": hint.about,
        }
        if hint.kind:
            answer["kind"] = _HINT_KINDS[hint.kind]
        answers.append(answer)
    return answers


def _links(session: Session, params: Json) -> list[Json]:
    found = session.file(params)
    return [
        {"range": session.range(span), "target": session.uri(path)}
        for span, path in (links(found[1]) if found is not None else ())
    ]


def _lenses(session: Session, params: Json) -> list[Json]:
    found = session.file(params)
    if found is None:
        return []
    answers = []
    for lens in lenses(found[1]):
        range_ = session.range(lens.name)
        answer: Json = {"range": range_}
        if lens.offer == "references":
            # They are counted when the line comes into sight.
            answer["data"] = {"uri": params["textDocument"]["uri"], "position": range_["start"]}
        elif (command := f"swarmdsl.{lens.offer}") in session.commands:
            subject = {"kind": lens.kind, "name": lens.name.text}
            answer["command"] = {
                "title": lens.offer.capitalize(),
                "command": command,
                "arguments": [params["textDocument"]["uri"], subject],
            }
        else:
            continue
        answers.append(answer)
    return answers


def _resolve_lens(session: Session, params: Json) -> Json:
    data = params.get("data")
    if not isinstance(data, dict):
        return params
    document = {"uri": data.get("uri")}
    place = session.place({"textDocument": document, "position": data.get("position")})
    found = occurrence_at(*place) if place is not None else None
    uses = occurrences_of(found.node, place[0]) if found is not None and place is not None else ()
    spans = dict.fromkeys(each.span for each in uses if not each.declares)
    locations = [each for each in map(session.location, spans) if each is not None]
    title = f"{len(locations)} reference{'s' * (len(locations) != 1)}"
    command = "swarmdsl.references" if "swarmdsl.references" in session.commands else ""
    arguments = [data["uri"], data["position"], locations] if command else []
    return {**params, "command": {"title": title, "command": command, "arguments": arguments}}


REQUESTS: Mapping[str, Callable[[Session, Json], Any]] = {
    "textDocument/hover": _hover,
    "textDocument/documentSymbol": _document_symbols,
    "textDocument/semanticTokens/full": _tokens,
    "textDocument/semanticTokens/full/delta": _token_changes,
    "textDocument/semanticTokens/range": _tokens_in_range,
    "textDocument/foldingRange": _folds,
    "textDocument/selectionRange": _selections,
    "textDocument/inlayHint": _hints,
    "textDocument/documentLink": _links,
    "textDocument/codeLens": _lenses,
    "codeLens/resolve": _resolve_lens,
}
