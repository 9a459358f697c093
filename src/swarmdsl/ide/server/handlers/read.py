"""Handlers for reading: hover, outline, semantic tokens, folding, hints, links, lenses."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from lsprotocol import types as lsp

from swarmdsl.base.source import Span
from swarmdsl.driver.workspace.references import occurrence_at, occurrences_of, owners
from swarmdsl.ide.server import symbols
from swarmdsl.ide.server.code_lens import code_lenses
from swarmdsl.ide.server.folding_range import folding_ranges
from swarmdsl.ide.server.hover import hover
from swarmdsl.ide.server.inlay_hint import inlay_hints
from swarmdsl.ide.server.links import document_links
from swarmdsl.ide.server.positions import Position
from swarmdsl.ide.server.selection_range import selection_ranges
from swarmdsl.ide.server.semantic_tokens import changes
from swarmdsl.ide.server.session import Session
from swarmdsl.ide.server.symbol_kinds import SYMBOL_KINDS

_HINT_KINDS = {"type": lsp.InlayHintKind.Type, "parameter": lsp.InlayHintKind.Parameter}


def _hover(session: Session, params: lsp.HoverParams) -> lsp.Hover | None:
    place = session.place(params.text_document, params.position)
    found = hover(*place) if place is not None else None
    if found is None:
        return None
    span, text = found
    contents = lsp.MarkupContent(kind=lsp.MarkupKind.Markdown, value=text)
    return lsp.Hover(contents=contents, range=session.range(span))


def _document_symbols(
    session: Session, params: lsp.DocumentSymbolParams
) -> list[lsp.DocumentSymbol]:
    found = session.file(params.text_document)
    if found is None:
        return []
    before, session.symbol_cache = session.symbol_cache, {}
    for owner in owners(found[1]):
        start = session.start(owner.span)
        known = before.get(owner)
        if known is None or known[0] != start:
            converted = [_as_symbol(each, session) for each in symbols.symbols_of(owner)]
            known = (start, converted)
        session.symbol_cache[owner] = known
    return [
        each
        for _, converted in sorted(session.symbol_cache.values(), key=_start)
        for each in converted
    ]


def _start(of: tuple[Position, object]) -> Position:
    return of[0]


def _as_symbol(symbol: symbols.Symbol, session: Session) -> lsp.DocumentSymbol:
    return lsp.DocumentSymbol(
        name=symbol.name,
        detail=symbol.detail,
        kind=SYMBOL_KINDS.get(symbol.kind, lsp.SymbolKind.Object),
        range=session.range(symbol.span),
        selection_range=session.range(symbol.selection),
        children=[_as_symbol(each, session) for each in symbol.inside],
    )


def _tokens(
    session: Session, params: lsp.SemanticTokensParams | lsp.SemanticTokensDeltaParams
) -> lsp.SemanticTokens | None:
    found = session.file(params.text_document)
    if found is None:
        return None
    data = session.semantic_tokens.tokens(*found, session.encoding)
    remembered = session.semantic_tokens.remember(found[1].source.name, data)
    return lsp.SemanticTokens(data=data, result_id=remembered)


def _token_changes(
    session: Session, params: lsp.SemanticTokensDeltaParams
) -> lsp.SemanticTokens | lsp.SemanticTokensDelta | None:
    found = session.file(params.text_document)
    if found is None:
        return None
    name = found[1].source.name
    before = session.semantic_tokens.remembered(name, params.previous_result_id)
    answer = _tokens(session, params)
    if before is None or answer is None:
        return answer
    edits = [
        lsp.SemanticTokensEdit(start=start, delete_count=count, data=data)
        for start, count, data in changes(before, answer.data)
    ]
    return lsp.SemanticTokensDelta(edits=edits, result_id=answer.result_id)


def _tokens_in_range(
    session: Session, params: lsp.SemanticTokensRangeParams
) -> lsp.SemanticTokens | None:
    found = session.file(params.text_document)
    if found is None:
        return None
    part = session.span(found[1], params.range)
    return lsp.SemanticTokens(data=session.semantic_tokens.tokens(*found, session.encoding, part))


def _folding_ranges(session: Session, params: lsp.FoldingRangeParams) -> list[lsp.FoldingRange]:
    found = session.file(params.text_document)
    return [
        lsp.FoldingRange(start_line=each.first, end_line=each.last, kind=each.kind or None)
        for each in (folding_ranges(found[1].source) if found is not None else ())
    ]


def _selection_ranges(
    session: Session, params: lsp.SelectionRangeParams
) -> list[lsp.SelectionRange]:
    found = session.file(params.text_document)
    if found is None:
        return []
    answers = []
    for at in params.positions:
        answer: lsp.SelectionRange | None = None
        for span in reversed(selection_ranges(found[1], session.offset(found[1], at))):
            answer = lsp.SelectionRange(range=session.range(span), parent=answer)
        answers.append(answer or lsp.SelectionRange(range=lsp.Range(start=at, end=at)))
    return answers


def _inlay_hints(session: Session, params: lsp.InlayHintParams) -> list[lsp.InlayHint]:
    found = session.file(params.text_document)
    if found is None:
        return []
    file = found[1]
    return [
        lsp.InlayHint(
            position=session.range(Span(file.source, hint.offset, hint.offset)).start,
            label=hint.text,
            tooltip=hint.about,
            kind=_HINT_KINDS.get(hint.kind),
        )
        for hint in inlay_hints(file, session.span(file, params.range))
    ]


def _document_links(session: Session, params: lsp.DocumentLinkParams) -> list[lsp.DocumentLink]:
    found = session.file(params.text_document)
    return [
        lsp.DocumentLink(range=session.range(span), target=session.uri(path))
        for span, path in (document_links(found[1]) if found is not None else ())
    ]


def _code_lenses(session: Session, params: lsp.CodeLensParams) -> list[lsp.CodeLens]:
    found = session.file(params.text_document)
    if found is None:
        return []
    uri = params.text_document.uri
    answers = []
    for lens in code_lenses(found[1]):
        range_ = session.range(lens.name)
        command = f"swarmdsl.{lens.offer}"
        if lens.offer == "references":
            # References are counted in codeLens/resolve, when the lens becomes visible.
            answers.append(lsp.CodeLens(range=range_, data={"uri": uri}))
        elif command in session.commands:
            subject = {"kind": lens.kind, "name": lens.name.text}
            checks = (lens.kind, lens.offer) == ("property", "simulate")
            title = "Check in simulation" if checks else lens.offer.capitalize()
            shown = lsp.Command(title=title, command=command, arguments=[uri, subject])
            answers.append(lsp.CodeLens(range=range_, command=shown))
    return answers


def _resolve_lens(session: Session, lens: lsp.CodeLens) -> lsp.CodeLens:
    if not isinstance(lens.data, dict) or not isinstance(uri := lens.data.get("uri"), str):
        return lens
    at = lens.range.start
    place = session.place(lsp.TextDocumentIdentifier(uri=uri), at)
    found = occurrence_at(*place) if place is not None else None
    uses = occurrences_of(found.node, place[0]) if found is not None and place is not None else ()
    spans = dict.fromkeys(each.span for each in uses if not each.declares)
    locations = [each for each in map(session.location, spans) if each is not None]
    title = f"{len(locations)} reference{'s' * (len(locations) != 1)}"
    command = "swarmdsl.references" if "swarmdsl.references" in session.commands else ""
    arguments = [uri, at, locations] if command else []
    lens.command = lsp.Command(title=title, command=command, arguments=arguments)
    return lens


REQUESTS: Mapping[str, Callable[[Session, Any], Any]] = {
    lsp.TEXT_DOCUMENT_HOVER: _hover,
    lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL: _document_symbols,
    lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL: _tokens,
    lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL_DELTA: _token_changes,
    lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_RANGE: _tokens_in_range,
    lsp.TEXT_DOCUMENT_FOLDING_RANGE: _folding_ranges,
    lsp.TEXT_DOCUMENT_SELECTION_RANGE: _selection_ranges,
    lsp.TEXT_DOCUMENT_INLAY_HINT: _inlay_hints,
    lsp.TEXT_DOCUMENT_DOCUMENT_LINK: _document_links,
    lsp.TEXT_DOCUMENT_CODE_LENS: _code_lenses,
    lsp.CODE_LENS_RESOLVE: _resolve_lens,
}
