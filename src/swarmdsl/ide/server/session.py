"""State of a client session: open documents, models and published diagnostics."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path, PurePosixPath
from typing import Any
from urllib.parse import unquote, unquote_to_bytes, urlsplit

from lsprotocol import types as lsp
from pygls.capabilities import get_capability
from pygls.lsp.server import LanguageServer

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.ide.server.diagnostics import to_lsp_diagnostics, to_range
from swarmdsl.ide.server.documents import Document
from swarmdsl.ide.server.models import Models
from swarmdsl.ide.server.positions import Position, bounds, offset, position
from swarmdsl.ide.server.semantic_tokens import SemanticTokenCache
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import TopLevel

Place = tuple[Workspace, File, int]


class Session:
    """Open files and models of a client.

    `dirty` is True if the diagnostics may differ from those published last.
    """

    def __init__(self, client: LanguageServer) -> None:
        self.client = client
        self.models = Models()
        self.encoding = "utf-16"
        # Commands that the client implements (`initializationOptions`).
        self.commands: frozenset[str] = frozenset()
        self.documents: dict[Path, Document] = {}
        self.semantic_tokens = SemanticTokenCache()
        # Document symbols that were sent last, with the start position of their declaration.
        self.symbol_cache: dict[TopLevel, tuple[Position, list[lsp.DocumentSymbol]]] = {}
        self.dirty = False
        # Files that a message was shown about.
        self.told: set[str] = set()
        self._uris: dict[Path, str] = {}
        # Files that have no place on disk yet, by URI.
        self._untitled: dict[str, Path] = {}
        self._published: dict[str, list[Diagnostic]] = {}
        self._changed: set[str] = set()

    def initialize(self, options: Any) -> None:
        """Store the position encoding and the initialization options."""
        self.encoding = lsp.PositionEncodingKind(self.client.workspace.position_encoding).value
        commands = options.get("commands") if isinstance(options, dict) else None
        known = commands if isinstance(commands, list) else []
        self.commands = frozenset(each for each in known if isinstance(each, str))

    def has_capability(self, capability: str) -> bool:
        """Return True if the client has a capability, e.g. `window.work_done_progress`."""
        return bool(get_capability(self.client.client_capabilities, capability, False))

    def path(self, uri: str) -> Path | None:
        """Return the path of a URI, or None if it names no file."""
        try:
            parts = urlsplit(uri)
        except ValueError:
            return None
        if parts.scheme == "untitled":
            return self._untitled_path(uri, parts.path)
        if parts.scheme != "file":
            return None
        # A `?` belongs to the file name: editors do not escape it.
        name = parts.path + (f"?{parts.query}" if parts.query else "")
        name = os.fsdecode(unquote_to_bytes(name.encode("utf-8", "surrogatepass")))
        if "\0" in name or not name.startswith("/"):
            return None
        if sys.platform == "win32":
            name = f"//{parts.netloc}{name}" if parts.netloc else name.lstrip("/")
        return Path(os.path.normpath(name))

    def _untitled_path(self, uri: str, name: str) -> Path | None:
        """Return a path for a new file: in the first open folder, where its imports are found."""
        if uri not in self._untitled:
            folder = next(iter(self.models.folders), Path.home())
            last = PurePosixPath(unquote(name)).name
            if not last or "\0" in last:
                return None
            # No file on disk has it, and no project.
            self._untitled[uri] = folder / f".{last}.untitled"
        return self._untitled[uri]

    def tell_once(self, message: str, name: str) -> None:
        """Show a message about a file, unless it was shown before."""
        if name not in self.told:
            self.told.add(name)
            text = f"{Path(name).name}: {message}"
            self.client.window_show_message(
                lsp.ShowMessageParams(type=lsp.MessageType.Info, message=text)
            )

    def uri(self, path: Path) -> str:
        """Return the URI under which the client knows a file."""
        return self._uris.get(path) or path.absolute().as_uri()

    def did_open(self, document: lsp.TextDocumentItem) -> None:
        """Add a document that the client has opened."""
        path = self.path(document.uri)
        if path is not None:
            self._uris[path] = document.uri
            self.documents[path] = Document(document.text, document.version)
            self._did_edit(path)

    def did_change(
        self,
        document: lsp.VersionedTextDocumentIdentifier,
        changes: Iterable[lsp.TextDocumentContentChangeEvent],
    ) -> None:
        """Apply changes to the text of an open document."""
        path = self.path(document.uri)
        known = self.documents.get(path) if path is not None else None
        if path is not None and known is not None:
            known.change(changes, self.encoding)
            known.version = document.version
            self._did_edit(path)

    def did_close(self, document: lsp.TextDocumentIdentifier) -> None:
        """Drop an open document; its file is read from disk again."""
        path = self.path(document.uri)
        if path is not None and self.documents.pop(path, None) is not None:
            self._changed.discard(self._uris.pop(path, ""))
            self.told.discard(str(path))
            self._untitled.pop(document.uri, None)
            self.models.close(path)
            self.semantic_tokens.forget(str(path))
            self.symbol_cache.clear()
            self.dirty = True

    def _did_edit(self, path: Path) -> None:
        self._changed.add(self.uri(path))
        self.models.edit(path, self.documents[path].text)
        self.dirty = True

    def open_folders(self, folders: Iterable[Path]) -> None:
        """Replace the folders that are open in the editor."""
        self.models.open_folders(folders)
        self.dirty = True

    def refresh(self, paths: Iterable[Path]) -> None:
        """Read files again that changed on disk; those that are open have been saved."""
        paths = list(paths)
        for path in paths:
            if path in self.documents:
                self.documents[path].typed_line = None
        self.models.refresh(paths)
        self.dirty = True

    def file(self, document: lsp.TextDocumentIdentifier) -> tuple[Workspace, File] | None:
        """Return an open file and the workspace that it belongs to."""
        path = self.path(document.uri)
        return self.models.file(path) if path is not None else None

    def place(self, document: lsp.TextDocumentIdentifier, at: lsp.Position) -> Place | None:
        """Return the position of a request as workspace, file and offset."""
        found = self.file(document)
        return (*found, self.offset(found[1], at)) if found is not None else None

    def place_on_disk(self, uri: str, at: lsp.Position) -> Place | None:
        """Return a position in a file of any workspace, open or not."""
        path = self.path(uri)
        for workspace in self.models.all() if path is not None else ():
            file = workspace.file(path) if path is not None else None
            if file is not None:
                return workspace, file, self.offset(file, at)
        return None

    def offset(self, file: File, at: lsp.Position) -> int:
        """Return the offset of a position in a file."""
        return offset(file.source, (at.line, at.character), self.encoding)

    def span(self, file: File, range_: lsp.Range) -> Span:
        """Return the span of a range in a file."""
        start, end = self.offset(file, range_.start), self.offset(file, range_.end)
        return Span(file.source, min(start, end), max(start, end))

    def start(self, span: Span) -> Position:
        """Return line and character of the start of a span."""
        source, start, _ = span.absolute
        return position(source, start, self.encoding)

    def range(self, span: Span) -> lsp.Range:
        """Return the range of a span in its file."""
        return to_range(span, self.encoding)

    def location(self, span: Span) -> lsp.Location | None:
        """Return the location of a span, or None if its source has no file."""
        whole = span.absolute
        if whole.source.path is None:
            return None
        return lsp.Location(uri=self.uri(whole.source.path), range=self.range(whole))

    def workspace_edit(self, changes: Iterable[tuple[Span, str]]) -> lsp.WorkspaceEdit:
        """Group replacements by file into a workspace edit."""
        found: dict[str, list[lsp.TextEdit]] = {}
        for span, text in changes:
            location = self.location(span)
            if location is not None:
                edit = lsp.TextEdit(range=location.range, new_text=text)
                found.setdefault(location.uri, []).append(edit)
        return lsp.WorkspaceEdit(changes=found)

    def publish_diagnostics(self) -> None:
        """Publish diagnostics of files that were edited or whose diagnostics changed."""
        self.dirty = False
        found: dict[str, list[Diagnostic]] = {}
        for workspace, name, diagnostics in self.models.diagnostics():
            # Diagnostics without a file are shown in an open one.
            alone = self.models.opened(workspace)[:1] if workspace is not None else []
            for path in [Path(name)] if name else alone:
                shown = (each for each in diagnostics if not self._is_begun(path, each))
                found.setdefault(self.uri(path), []).extend(shown)
        for uri in {**self._published, **found, **dict.fromkeys(self._changed)}:
            now = found.get(uri, [])
            if uri in self._changed or now != self._published.get(uri, []):
                self._publish(uri, now)
        self._changed.clear()
        self._published = {uri: each for uri, each in found.items() if each}

    def _is_begun(self, path: Path, found: Diagnostic) -> bool:
        """Return True for an empty file that is open, or documentation that is being typed."""
        document = self.documents.get(path)
        if document is None or found.name == "empty-file":
            return document is not None
        if found.name != "unattached-doc-comment" or document.typed_line is None:
            return False
        comment = found.primary
        lines = [line for line, _ in bounds(comment.span, self.encoding)] if comment else []
        return bool(lines) and lines[0] <= document.typed_line <= lines[1] + 1

    def _publish(self, uri: str, found: Sequence[Diagnostic]) -> None:
        path = self.path(uri)
        document = self.documents.get(path) if path is not None else None
        self.client.text_document_publish_diagnostics(
            lsp.PublishDiagnosticsParams(
                uri=uri,
                diagnostics=to_lsp_diagnostics(found, self.encoding, self.uri),
                version=document.version if document is not None else None,
            )
        )
