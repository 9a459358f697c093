"""Answers that lead somewhere: to what a name means, to where it is used."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from swarmdsl.server import symbols
from swarmdsl.server.connection import Json
from swarmdsl.server.session import Session
from swarmdsl.server.words import SYMBOL_KINDS, SYMBOL_OBJECT
from swarmdsl.workspace.occurrences import Occurrence, occurrence_at, occurrences_of

_READ, _WRITE = 2, 3
CAPABILITIES: Json = {
    "definitionProvider": True,
    "referencesProvider": True,
    "documentHighlightProvider": True,
    "workspaceSymbolProvider": True,
}


def _definition(session: Session, params: Json) -> Json | None:
    place = session.place(params)
    found = occurrence_at(*place) if place is not None else None
    return session.location(found.node.name.span) if found is not None else None  # type: ignore[attr-defined]


def _same(session: Session, params: Json) -> Iterator[Occurrence]:
    """All names that mean what the one at a position means."""
    place = session.place(params)
    found = occurrence_at(*place) if place is not None else None
    if place is not None and found is not None:
        yield from occurrences_of(found.node, place[0])


def _references(session: Session, params: Json) -> list[Json]:
    context = params.get("context")
    declared = isinstance(context, dict) and bool(context.get("includeDeclaration"))
    spans = [each.span for each in _same(session, params) if declared or not each.declares]
    locations = (session.location(span) for span in dict.fromkeys(spans))
    return [each for each in locations if each is not None]


def _highlights(session: Session, params: Json) -> list[Json]:
    found = session.file(params)
    if found is None:
        return []
    return [
        {"range": session.range(each.span), "kind": _WRITE if each.declares else _READ}
        for each in _same(session, params)
        if each.span.source is found[1].source
    ]


def _workspace_symbols(session: Session, params: Json) -> list[Json]:
    query = params.get("query")
    found = []
    for workspace in session.models.all():
        for each in symbols.search(workspace, query if isinstance(query, str) else ""):
            location = session.location(each.selection)
            if location is not None:
                kind = SYMBOL_KINDS.get(each.kind, SYMBOL_OBJECT)
                found.append({"location": location, "name": each.name, "kind": kind})
    return found


REQUESTS: Mapping[str, Callable[[Session, Json], Any]] = {
    "textDocument/definition": _definition,
    "textDocument/references": _references,
    "textDocument/documentHighlight": _highlights,
    "workspace/symbol": _workspace_symbols,
}
