"""Handler of completion: entries and snippets as items of the protocol."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from lsprotocol import types as lsp

from swarmdsl.base.source import Span
from swarmdsl.driver.line_insertion import import_statement
from swarmdsl.ide.server.completion import completions
from swarmdsl.ide.server.completion_entry import Completion
from swarmdsl.ide.server.hover import described
from swarmdsl.ide.server.session import Place, Session
from swarmdsl.ide.server.snippets import snippets
from swarmdsl.ide.server.symbol_kinds import COMPLETION_KINDS

# Text before a blank after which a name or a unit follows. A list that is empty there would hide
# the one of a word that is typed before the answer arrives.
_BEFORE_NAME = re.compile(
    r"(?:[-=]>|[=:,/(\[<>]|\b(?:on|do|send|cancel|initial|behavior|connect|extends|environment|"
    r"fitness|import|defer|of|in|to|state|and|or|not|event|function)|"
    r"(?<![\w.])\d+(?:\.\d+)?)[ ]\Z"
)


def _completion(session: Session, params: lsp.CompletionParams) -> list[lsp.CompletionItem]:
    place = session.place(params.text_document, params.position)
    if place is None or not _is_asked(place, params.context):
        return []
    fills = session.has_capability("text_document.completion.completion_item.snippet_support")
    entries = completions(*place)
    items = [_item(each, index, session, place, fills) for index, each in enumerate(entries)]
    return [*items, *(_snippets(place, entries) if fills else ())]


def _is_asked(place: Place, context: lsp.CompletionContext | None) -> bool:
    """Return True unless a typed character begins no list here."""
    if context is None or context.trigger_kind != lsp.CompletionTriggerKind.TriggerCharacter:
        return True
    _, file, offset = place
    line = file.source.text[:offset].rpartition("\n")[2]
    match context.trigger_character:
        case " ":
            return _BEFORE_NAME.search(line) is not None
        case "/":
            return re.search(r"[\w\"][^\s]*/\Z", line) is not None
        case '"':
            return re.match(r"\s*import\b", line) is not None
    return True


def _item(
    entry: Completion, index: int, session: Session, place: Place, fills: bool
) -> lsp.CompletionItem:
    item = lsp.CompletionItem(
        label=entry.word, detail=entry.detail, kind=_kind(entry), sort_text=f"{index:05}"
    )
    if entry.node is not None:
        text = described(entry.node)
        item.documentation = lsp.MarkupContent(kind=lsp.MarkupKind.Markdown, value=text)
    if entry.replaced is not None:
        item.text_edit = lsp.TextEdit(range=session.range(entry.replaced), new_text=entry.word)
    if entry.added is not None:
        file = place[1]
        start, end, text = import_statement(file, entry.added)
        where = session.range(Span(file.source, start, end))
        item.additional_text_edits = [lsp.TextEdit(range=where, new_text=text)]
    if fills and entry.text is not None:
        item.insert_text = entry.text
        item.insert_text_format = lsp.InsertTextFormat.Snippet
    return item


def _kind(entry: Completion) -> lsp.CompletionItemKind:
    if entry.node is not None:
        return COMPLETION_KINDS.get(type(entry.node), lsp.CompletionItemKind.Variable)
    known = {
        "keyword": lsp.CompletionItemKind.Keyword,
        "file": lsp.CompletionItemKind.File,
        "folder": lsp.CompletionItemKind.Folder,
        "package": lsp.CompletionItemKind.Module,
        "unit": lsp.CompletionItemKind.Unit,
    }
    if entry.detail in known:
        return known[entry.detail]
    if entry.text is not None:
        return lsp.CompletionItemKind.Function
    return lsp.CompletionItemKind.Struct


def _snippets(place: Place, entries: list[Completion]) -> Iterator[lsp.CompletionItem]:
    """Yield the snippets that begin with one of the possible keywords."""
    keywords = {each.word for each in entries if each.detail == "keyword"}
    for snippet in snippets(keywords, *place):
        yield lsp.CompletionItem(
            label=snippet.label,
            detail=snippet.about,
            kind=lsp.CompletionItemKind.Snippet,
            # With a blank in it, the item would stay when a name is typed after a keyword.
            filter_text=snippet.label.removesuffix(" ...").replace(" ", "-"),
            insert_text=snippet.text,
            insert_text_format=lsp.InsertTextFormat.Snippet,
            sort_text=f"9{snippet.label}",
        )


REQUESTS: Mapping[str, Callable[[Session, Any], Any]] = {
    lsp.TEXT_DOCUMENT_COMPLETION: _completion,
}
