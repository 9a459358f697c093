"""Answers that lead somewhere: to what a name means, to where it is used."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from swarmdsl.scopes import bare, kind_of
from swarmdsl.server import symbols
from swarmdsl.server.connection import INVALID_PARAMS, Json, RequestError
from swarmdsl.server.reach import REACHED, ways_from, ways_to
from swarmdsl.server.session import Session
from swarmdsl.server.words import SYMBOL_KINDS, SYMBOL_OBJECT
from swarmdsl.syntax import Node, Optimization
from swarmdsl.workspace.occurrences import Occurrence, occurrence_at, occurrences_of

_READ, _WRITE = 2, 3
CAPABILITIES: Json = {
    "definitionProvider": True,
    "referencesProvider": True,
    "documentHighlightProvider": True,
    "workspaceSymbolProvider": True,
    "callHierarchyProvider": True,
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


def _prepare_calls(session: Session, params: Json) -> list[Json] | None:
    place = session.place(params)
    found = occurrence_at(*place) if place is not None else None
    if found is None or not isinstance(found.node, REACHED):
        return None
    item = _as_item(session, found.node)
    return [item] if item is not None else None


def _as_item(session: Session, node: Node) -> Json | None:
    """A state or the like for the list of those that reach each other."""
    if isinstance(node, Optimization):
        return None
    name = node.name.span  # type: ignore[attr-defined]
    whole, location = session.location(node.span), session.location(name)
    if whole is None or location is None:
        return None
    return {
        "name": name.text,
        "kind": SYMBOL_KINDS.get(type(node), SYMBOL_OBJECT),
        "detail": bare(kind_of(node)),
        "uri": location["uri"],
        "range": whole["range"],
        "selectionRange": location["range"],
    }


def _ways(session: Session, params: Json, *, to: bool) -> list[Json]:
    item = params.get("item")
    if not isinstance(item, dict) or not isinstance(item.get("selectionRange"), dict):
        raise RequestError(INVALID_PARAMS, "the item is missing")
    place = session.place_on_disk(item.get("uri"), item["selectionRange"].get("start"))
    found = occurrence_at(*place) if place is not None else None
    if place is None or found is None:
        return []
    ways = (ways_to if to else ways_from)(place[0], found.node)
    end = "from" if to else "to"
    return [
        {end: item, "fromRanges": [session.range(span.absolute) for span in spans]}
        for node, spans in ways.items()
        if (item := _as_item(session, node)) is not None
    ]


def _ways_to(session: Session, params: Json) -> list[Json]:
    return _ways(session, params, to=True)


def _ways_from(session: Session, params: Json) -> list[Json]:
    return _ways(session, params, to=False)


REQUESTS: Mapping[str, Callable[[Session, Json], Any]] = {
    "textDocument/definition": _definition,
    "textDocument/references": _references,
    "textDocument/documentHighlight": _highlights,
    "workspace/symbol": _workspace_symbols,
    "textDocument/prepareCallHierarchy": _prepare_calls,
    "callHierarchy/incomingCalls": _ways_to,
    "callHierarchy/outgoingCalls": _ways_from,
}
