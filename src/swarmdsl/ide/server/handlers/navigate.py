"""Handlers for navigation: definition, references, symbols, call hierarchy."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from lsprotocol import types as lsp

from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import Occurrence, occurrence_at, occurrences_of
from swarmdsl.ide.server import symbols
from swarmdsl.ide.server.call_hierarchy import CALLABLE, incoming_calls, outgoing_calls
from swarmdsl.ide.server.links import document_links
from swarmdsl.ide.server.session import Place, Session
from swarmdsl.ide.server.symbol_kinds import SYMBOL_KINDS
from swarmdsl.syntax.ast import Node, Optimization, name_of


def _definition(session: Session, params: lsp.DefinitionParams) -> lsp.Location | None:
    place = session.place(params.text_document, params.position)
    found = occurrence_at(*place) if place is not None else None
    if found is not None:
        return session.location(name_of(found.node).span)
    for span, path in document_links(place[1]) if place is not None else ():
        if place is not None and span.start <= place[2] <= span.end:
            start = lsp.Position(line=0, character=0)
            return lsp.Location(uri=session.uri(path), range=lsp.Range(start=start, end=start))
    return None


def _occurrences(place: Place | None) -> Iterator[Occurrence]:
    """Yield all occurrences of the element at a position."""
    found = occurrence_at(*place) if place is not None else None
    if place is not None and found is not None:
        yield from occurrences_of(found.node, place[0])


def _references(session: Session, params: lsp.ReferenceParams) -> list[lsp.Location]:
    same = _occurrences(session.place(params.text_document, params.position))
    declared = params.context.include_declaration
    spans = [each.span for each in same if declared or not each.declares]
    locations = (session.location(span) for span in dict.fromkeys(spans))
    return [each for each in locations if each is not None]


def _highlights(
    session: Session, params: lsp.DocumentHighlightParams
) -> list[lsp.DocumentHighlight]:
    place = session.place(params.text_document, params.position)
    kinds = {True: lsp.DocumentHighlightKind.Write, False: lsp.DocumentHighlightKind.Read}
    return [
        lsp.DocumentHighlight(range=session.range(each.span), kind=kinds[each.declares])
        for each in _occurrences(place)
        if place is not None and each.span.source is place[1].source
    ]


def _workspace_symbols(
    session: Session, params: lsp.WorkspaceSymbolParams
) -> list[lsp.WorkspaceSymbol]:
    found = []
    for workspace in session.models.all():
        for each in symbols.search(workspace, params.query):
            location = session.location(each.selection)
            if location is not None:
                kind = SYMBOL_KINDS.get(each.kind, lsp.SymbolKind.Object)
                found.append(lsp.WorkspaceSymbol(location=location, name=each.name, kind=kind))
    return found


def _prepare_calls(
    session: Session, params: lsp.CallHierarchyPrepareParams
) -> list[lsp.CallHierarchyItem] | None:
    place = session.place(params.text_document, params.position)
    found = occurrence_at(*place) if place is not None else None
    if found is None or not isinstance(found.node, CALLABLE):
        return None
    item = _as_item(session, found.node)
    return [item] if item is not None else None


def _as_item(session: Session, node: Node) -> lsp.CallHierarchyItem | None:
    """Convert a node into an item of the call hierarchy."""
    if isinstance(node, Optimization):
        return None
    name = name_of(node).span
    whole, location = session.location(node.span), session.location(name)
    if whole is None or location is None:
        return None
    return lsp.CallHierarchyItem(
        name=name.text,
        kind=SYMBOL_KINDS.get(type(node), lsp.SymbolKind.Object),
        detail=kind_name(node),
        uri=location.uri,
        range=whole.range,
        selection_range=location.range,
    )


def _incoming_calls(
    session: Session, params: lsp.CallHierarchyIncomingCallsParams
) -> list[lsp.CallHierarchyIncomingCall]:
    return [
        lsp.CallHierarchyIncomingCall(from_=item, from_ranges=ranges)
        for item, ranges in _calls(session, params.item, incoming_calls)
    ]


def _outgoing_calls(
    session: Session, params: lsp.CallHierarchyOutgoingCallsParams
) -> list[lsp.CallHierarchyOutgoingCall]:
    return [
        lsp.CallHierarchyOutgoingCall(to=item, from_ranges=ranges)
        for item, ranges in _calls(session, params.item, outgoing_calls)
    ]


def _calls(
    session: Session,
    item: lsp.CallHierarchyItem,
    calls: Callable[[Workspace, Node], Mapping[Node, Sequence[Span]]],
) -> Iterator[tuple[lsp.CallHierarchyItem, list[lsp.Range]]]:
    """Yield the elements at the other end of calls, with the ranges of these calls."""
    place = session.place_on_disk(item.uri, item.selection_range.start)
    found = occurrence_at(*place) if place is not None else None
    if place is None or found is None:
        return
    for node, spans in calls(place[0], found.node).items():
        other = _as_item(session, node)
        if other is not None:
            yield other, [session.range(span.absolute) for span in spans]


REQUESTS: Mapping[str, Callable[[Session, Any], Any]] = {
    lsp.TEXT_DOCUMENT_DEFINITION: _definition,
    lsp.TEXT_DOCUMENT_REFERENCES: _references,
    lsp.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT: _highlights,
    lsp.WORKSPACE_SYMBOL: _workspace_symbols,
    lsp.TEXT_DOCUMENT_PREPARE_CALL_HIERARCHY: _prepare_calls,
    lsp.CALL_HIERARCHY_INCOMING_CALLS: _incoming_calls,
    lsp.CALL_HIERARCHY_OUTGOING_CALLS: _outgoing_calls,
}
