"""The features of the language server, each from a request of an editor to its answer."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException
from pygls.lsp.server import LanguageServer
from pygls.uris import from_fs_path, to_fs_path

from swarmdsl import __version__
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.format import formatted
from swarmdsl.load import File
from swarmdsl.server import hover as hovering
from swarmdsl.server import symbols
from swarmdsl.server.completion import completions
from swarmdsl.server.findings import as_findings, as_range
from swarmdsl.server.fixes import fix
from swarmdsl.server.models import Models
from swarmdsl.server.positions import offset
from swarmdsl.server.words import COMPLETION_KINDS, SYMBOL_KINDS
from swarmdsl.source import Span
from swarmdsl.workspace import Workspace
from swarmdsl.workspace.occurrences import Occurrence, occurrence_at, occurrences_of
from swarmdsl.workspace.renaming import RefusedError, renamable, rename

Place = tuple[Workspace, File, int]

# Files whose changes on disk the editor tells of, if it can.
_WATCHED = lsp.Registration(
    id="watched-files",
    method=lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES,
    register_options=lsp.DidChangeWatchedFilesRegistrationOptions(
        watchers=[
            lsp.FileSystemWatcher(glob_pattern=f"**/{name}")
            for name in ("*.swarm", "swarm.toml", "*.{msg,srv,action}")
        ]
    ),
)


class Server(LanguageServer):
    """A language server, and the models that its client has open."""

    def __init__(self) -> None:
        super().__init__("swarmc", __version__)
        self.models = Models()
        self._uris: dict[Path, str] = {}
        self._told: dict[str, list[lsp.Diagnostic]] = {}

    @property
    def encoding(self) -> str:
        """In which units the client counts characters."""
        return str(getattr(self.workspace.position_encoding, "value", "utf-16"))

    def path(self, uri: str) -> Path | None:
        """The file that a client names; None for what is no file."""
        found = to_fs_path(uri) if uri.startswith("file:") else None
        if found is None or "\0" in found:
            return None
        path = Path(found)
        self._uris[path] = uri
        return path

    def uri(self, path: Path) -> str:
        """How the client names a file."""
        path = path.absolute()
        return self._uris.get(path) or from_fs_path(str(path)) or path.as_uri()

    def place(self, uri: str, at: lsp.Position) -> Place | None:
        """A position in an open file, and the model that the file belongs to."""
        path = self.path(uri)
        found = self.models.file(path) if path is not None else None
        if found is None:
            return None
        workspace, file = found
        return workspace, file, offset(file.source, (at.line, at.character), self.encoding)

    def location(self, span: Span) -> lsp.Location | None:
        """A place in a file; None for text that comes with swarmdsl in another form."""
        whole = span.absolute
        if whole.source.path is None:
            return None
        return lsp.Location(uri=self.uri(whole.source.path), range=as_range(whole, self.encoding))

    def tell(self) -> None:
        """Send what is wrong with each file of which something else was sent before."""
        found: dict[str, list[lsp.Diagnostic]] = {}
        for workspace in self.models:
            by_name = workspace.diagnostics()
            for name, diagnostics in by_name.items():
                # What concerns no place in a file is told of one that is open.
                paths = [Path(name)] if name else self.models.opened(workspace)[:1]
                told = as_findings(diagnostics, self.encoding)
                for path in paths:
                    found.setdefault(self.uri(path), []).extend(told)
        for uri in {**self._told, **found}:
            diagnostics_of = found.get(uri, [])
            if diagnostics_of != self._told.get(uri, []):
                self.text_document_publish_diagnostics(
                    lsp.PublishDiagnosticsParams(uri=uri, diagnostics=diagnostics_of)
                )
        self._told = {uri: told for uri, told in found.items() if told}


def make_server() -> Server:
    """A server with all features, which listens to nobody yet."""
    server = Server()
    for feature, (answer, options) in _FEATURES.items():
        server.feature(feature, options)(answer)
    return server


def _initialized(server: Server, _params: lsp.InitializedParams) -> None:
    folders = server.workspace.folders.values()
    paths = [server.path(folder.uri) for folder in folders]
    if not paths and server.workspace.root_uri:
        paths = [server.path(server.workspace.root_uri)]
    server.models.folders = [path for path in paths if path is not None]
    offered = server.client_capabilities.workspace
    watching = offered.did_change_watched_files if offered is not None else None
    if watching is not None and watching.dynamic_registration:
        server.client_register_capability(lsp.RegistrationParams(registrations=[_WATCHED]))


def _changed(
    server: Server, params: lsp.DidOpenTextDocumentParams | lsp.DidChangeTextDocumentParams
) -> None:
    path = server.path(params.text_document.uri)
    if path is not None:
        document = server.workspace.get_text_document(params.text_document.uri)
        server.models.edit(path, document.source)
        server.tell()


def _closed(server: Server, params: lsp.DidCloseTextDocumentParams) -> None:
    path = server.path(params.text_document.uri)
    if path is not None:
        server.models.close(path)
        server.tell()


def _on_disk(server: Server, params: lsp.DidChangeWatchedFilesParams) -> None:
    paths = [server.path(change.uri) for change in params.changes]
    server.models.refresh([path for path in paths if path is not None])
    server.tell()


def _hover(server: Server, params: lsp.HoverParams) -> lsp.Hover | None:
    place = server.place(params.text_document.uri, params.position)
    found = hovering.hover(*place) if place is not None else None
    if found is None:
        return None
    span, text = found
    content = lsp.MarkupContent(kind=lsp.MarkupKind.Markdown, value=text)
    return lsp.Hover(contents=content, range=as_range(span, server.encoding))


def _definition(server: Server, params: lsp.DefinitionParams) -> lsp.Location | None:
    place = server.place(params.text_document.uri, params.position)
    found = occurrence_at(*place) if place is not None else None
    return server.location(found.node.name.span) if found is not None else None  # type: ignore[attr-defined]


def _same(server: Server, uri: str, at: lsp.Position) -> Iterator[Occurrence]:
    """All names that mean what the one at a position means."""
    place = server.place(uri, at)
    found = occurrence_at(*place) if place is not None else None
    if place is not None and found is not None:
        yield from occurrences_of(found.node, place[0])


def _references(server: Server, params: lsp.ReferenceParams) -> list[lsp.Location]:
    same = _same(server, params.text_document.uri, params.position)
    wanted = (each for each in same if params.context.include_declaration or not each.declares)
    locations = (server.location(each.span) for each in wanted)
    return [location for location in locations if location is not None]


def _highlights(server: Server, params: lsp.DocumentHighlightParams) -> list[lsp.DocumentHighlight]:
    place = server.place(params.text_document.uri, params.position)
    if place is None:
        return []
    kinds = {True: lsp.DocumentHighlightKind.Write, False: lsp.DocumentHighlightKind.Read}
    return [
        lsp.DocumentHighlight(range=as_range(each.span, server.encoding), kind=kinds[each.declares])
        for each in _same(server, params.text_document.uri, params.position)
        if each.span.source is place[1].source
    ]


def _document_symbols(server: Server, params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:
    place = server.place(params.text_document.uri, lsp.Position(line=0, character=0))
    if place is None:
        return []
    return [_as_symbol(each, server.encoding) for each in symbols.outline(place[1])]


def _as_symbol(symbol: symbols.Symbol, encoding: str) -> lsp.DocumentSymbol:
    return lsp.DocumentSymbol(
        name=symbol.name,
        detail=symbol.detail,
        kind=SYMBOL_KINDS.get(symbol.kind, lsp.SymbolKind.Object),
        range=as_range(symbol.span, encoding),
        selection_range=as_range(symbol.selection, encoding),
        children=[_as_symbol(each, encoding) for each in symbol.inside],
    )


def _workspace_symbols(
    server: Server, params: lsp.WorkspaceSymbolParams
) -> list[lsp.WorkspaceSymbol]:
    found = []
    for workspace in server.models:
        for each in symbols.search(workspace, params.query):
            location = server.location(each.selection)
            if location is not None:
                kind = SYMBOL_KINDS.get(each.kind, lsp.SymbolKind.Object)
                found.append(lsp.WorkspaceSymbol(location=location, name=each.name, kind=kind))
    return found


def _completion(server: Server, params: lsp.CompletionParams) -> list[lsp.CompletionItem]:
    place = server.place(params.text_document.uri, params.position)
    if place is None:
        return []
    return [
        lsp.CompletionItem(
            label=each.word,
            detail=each.detail,
            kind=COMPLETION_KINDS.get(type(each.node), lsp.CompletionItemKind.Variable)
            if each.node is not None
            else lsp.CompletionItemKind.Keyword,
            documentation=lsp.MarkupContent(
                kind=lsp.MarkupKind.Markdown, value=hovering.described(each.node)
            )
            if each.node is not None
            else None,
            sort_text=f"{each.node is None:d}{index:05}",
        )
        for index, each in enumerate(completions(*place))
    ]


def _formatting(server: Server, params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit]:
    place = server.place(params.text_document.uri, lsp.Position(line=0, character=0))
    if place is None:
        return []
    source = place[1].source
    text = formatted(source, Diagnostics())
    if text is None or text == source.text:
        return []
    if "\r\n" in server.workspace.get_text_document(params.text_document.uri).source:
        text = text.replace("\n", "\r\n")
    whole = as_range(Span(source, 0, len(source.text)), server.encoding)
    return [lsp.TextEdit(range=whole, new_text=text)]


def _prepare_rename(
    server: Server, params: lsp.PrepareRenameParams
) -> lsp.PrepareRenamePlaceholder | None:
    place = server.place(params.text_document.uri, params.position)
    if place is None:
        return None
    try:
        found = renamable(*place)
    except RefusedError as error:
        raise JsonRpcException(str(error), lsp.LSPErrorCodes.RequestFailed.value) from error
    return lsp.PrepareRenamePlaceholder(
        range=as_range(found.span, server.encoding), placeholder=found.span.text
    )


def _rename(server: Server, params: lsp.RenameParams) -> lsp.WorkspaceEdit | None:
    place = server.place(params.text_document.uri, params.position)
    if place is None:
        return None
    try:
        spans = rename(*place, params.new_name)
    except RefusedError as error:
        raise JsonRpcException(str(error), lsp.LSPErrorCodes.RequestFailed.value) from error
    changes: dict[str, list[lsp.TextEdit]] = {}
    for span in spans:
        if span.source.path is not None:
            edit = lsp.TextEdit(range=as_range(span, server.encoding), new_text=params.new_name)
            changes.setdefault(server.uri(span.source.path), []).append(edit)
    return lsp.WorkspaceEdit(changes=changes)


def _code_actions(server: Server, params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
    place = server.place(params.text_document.uri, params.range.start)
    if place is None:
        return []
    workspace, file, start = place
    end = offset(file.source, (params.range.end.line, params.range.end.character), server.encoding)
    actions = []
    for found in workspace.diagnostics().get(file.source.name, []):
        span = found.primary.span if found.primary is not None else None
        mended = fix(found) if span and span.start <= end and start <= span.end else None
        if mended is not None:
            edit = lsp.TextEdit(range=as_range(mended.span, server.encoding), new_text=mended.text)
            actions.append(
                lsp.CodeAction(
                    title=mended.title,
                    kind=lsp.CodeActionKind.QuickFix,
                    diagnostics=as_findings([found], server.encoding),
                    edit=lsp.WorkspaceEdit(changes={params.text_document.uri: [edit]}),
                    is_preferred=True,
                )
            )
    return actions


_FEATURES: dict[str, tuple[Any, Any]] = {
    lsp.INITIALIZED: (_initialized, None),
    lsp.TEXT_DOCUMENT_DID_OPEN: (_changed, None),
    lsp.TEXT_DOCUMENT_DID_CHANGE: (_changed, None),
    lsp.TEXT_DOCUMENT_DID_CLOSE: (_closed, None),
    lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES: (_on_disk, None),
    lsp.TEXT_DOCUMENT_HOVER: (_hover, None),
    lsp.TEXT_DOCUMENT_DEFINITION: (_definition, None),
    lsp.TEXT_DOCUMENT_REFERENCES: (_references, None),
    lsp.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT: (_highlights, None),
    lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL: (_document_symbols, None),
    lsp.WORKSPACE_SYMBOL: (_workspace_symbols, None),
    lsp.TEXT_DOCUMENT_COMPLETION: (
        _completion,
        lsp.CompletionOptions(trigger_characters=[".", ">", ":", "["]),
    ),
    lsp.TEXT_DOCUMENT_FORMATTING: (_formatting, None),
    lsp.TEXT_DOCUMENT_PREPARE_RENAME: (_prepare_rename, None),
    lsp.TEXT_DOCUMENT_RENAME: (_rename, lsp.RenameOptions(prepare_provider=True)),
    lsp.TEXT_DOCUMENT_CODE_ACTION: (
        _code_actions,
        lsp.CodeActionOptions(code_action_kinds=[lsp.CodeActionKind.QuickFix]),
    ),
}
