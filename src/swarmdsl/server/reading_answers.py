"""Answers about one file for whoever reads it: what a name is, the outline."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from swarmdsl.server import symbols
from swarmdsl.server.connection import Json
from swarmdsl.server.hover import hover
from swarmdsl.server.session import Session
from swarmdsl.server.words import SYMBOL_KINDS, SYMBOL_OBJECT

CAPABILITIES: Json = {
    "hoverProvider": True,
    "documentSymbolProvider": True,
}


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


REQUESTS: Mapping[str, Callable[[Session, Json], Any]] = {
    "textDocument/hover": _hover,
    "textDocument/documentSymbol": _document_symbols,
}
