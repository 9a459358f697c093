"""What the server knows of its client: the files it has open, and what it was told of them."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any
from urllib.parse import unquote_to_bytes, urlsplit

from lsprotocol import types as lsp
from pygls.capabilities import get_capability
from pygls.lsp.server import LanguageServer

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.ide.server.diagnostics import as_findings, as_range
from swarmdsl.ide.server.documents import Document
from swarmdsl.ide.server.models import Models
from swarmdsl.ide.server.positions import Position, offset, position
from swarmdsl.ide.server.semantic_tokens import Painter
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import TopLevel

Place = tuple[Workspace, File, int]


class Session:
    """A client, its files and models; answers are made of it.

    `dirty` is whether what is wrong may be something else than was told.
    """

    def __init__(self, client: LanguageServer) -> None:
        self.client = client
        self.models = Models()
        self.encoding = "utf-16"
        # The commands of its own that the client offers to be named.
        self.commands: frozenset[str] = frozenset()
        self.documents: dict[Path, Document] = {}
        self.painter = Painter()
        # What was last told of declarations that may still be the same, and where they began.
        self.outlined: dict[TopLevel, tuple[Position, list[lsp.DocumentSymbol]]] = {}
        self.dirty = False
        self._uris: dict[Path, str] = {}
        self._told: dict[str, list[Diagnostic]] = {}
        self._changed: set[str] = set()

    def begin(self, options: Any) -> None:
        """Take what was agreed upon, and what a client says of itself beyond the protocol."""
        self.encoding = lsp.PositionEncodingKind(self.client.workspace.position_encoding).value
        commands = options.get("commands") if isinstance(options, dict) else None
        known = commands if isinstance(commands, list) else []
        self.commands = frozenset(each for each in known if isinstance(each, str))

    def offers(self, capability: str) -> bool:
        """Whether the client says that it can do something, by the path of that."""
        return bool(get_capability(self.client.client_capabilities, capability, False))

    def path(self, uri: str) -> Path | None:
        """The file that a client names; None for what is no file."""
        try:
            parts = urlsplit(uri)
        except ValueError:
            return None
        if parts.scheme != "file":
            return None
        # What looks like a query to a URL belongs to the name: editors leave `?` as it is.
        name = parts.path + (f"?{parts.query}" if parts.query else "")
        name = os.fsdecode(unquote_to_bytes(name.encode("utf-8", "surrogatepass")))
        if "\0" in name or not name.startswith("/"):
            return None
        if sys.platform == "win32":
            name = f"//{parts.netloc}{name}" if parts.netloc else name.lstrip("/")
        return Path(os.path.normpath(name))

    def uri(self, path: Path) -> str:
        """How the client names a file."""
        return self._uris.get(path) or path.absolute().as_uri()

    def opened(self, document: lsp.TextDocumentItem) -> None:
        """Take a file for one that the client shows."""
        path = self.path(document.uri)
        if path is not None:
            self._uris[path] = document.uri
            self.documents[path] = Document(document.text, document.version)
            self._edited(path)

    def changed(
        self,
        document: lsp.VersionedTextDocumentIdentifier,
        changes: Iterable[lsp.TextDocumentContentChangeEvent],
    ) -> None:
        """Take changes of the text of a file."""
        path = self.path(document.uri)
        known = self.documents.get(path) if path is not None else None
        if path is not None and known is not None:
            known.change(changes, self.encoding)
            known.version = document.version
            self._edited(path)

    def closed(self, document: lsp.TextDocumentIdentifier) -> None:
        """Take what is on disk for a file again."""
        path = self.path(document.uri)
        if path is not None and self.documents.pop(path, None) is not None:
            self._changed.discard(self._uris.pop(path, ""))
            self.models.close(path)
            self.painter.forget(str(path))
            self.outlined.clear()
            self.dirty = True

    def _edited(self, path: Path) -> None:
        self._changed.add(self.uri(path))
        self.models.edit(path, self.documents[path].text)
        self.dirty = True

    def open_folders(self, folders: Iterable[Path]) -> None:
        """Take folders for those that are open in the editor."""
        self.models.open_folders(folders)
        self.dirty = True

    def refresh(self, paths: Iterable[Path]) -> None:
        """Read files again that were changed on disk."""
        self.models.refresh(paths)
        self.dirty = True

    def file(self, document: lsp.TextDocumentIdentifier) -> tuple[Workspace, File] | None:
        """The open file that a request is about, and the model that it belongs to."""
        path = self.path(document.uri)
        return self.models.file(path) if path is not None else None

    def place(self, document: lsp.TextDocumentIdentifier, at: lsp.Position) -> Place | None:
        """The position that a request is about."""
        found = self.file(document)
        return (*found, self.offset(found[1], at)) if found is not None else None

    def place_on_disk(self, uri: str, at: lsp.Position) -> Place | None:
        """A position in a file that need not be open, if a model has it."""
        path = self.path(uri)
        for workspace in self.models.all() if path is not None else ():
            file = workspace.file(path) if path is not None else None
            if file is not None:
                return workspace, file, self.offset(file, at)
        return None

    def offset(self, file: File, at: lsp.Position) -> int:
        """The offset of a position in a file."""
        return offset(file.source, (at.line, at.character), self.encoding)

    def span(self, file: File, range_: lsp.Range) -> Span:
        """A part of a file that a request is about."""
        start, end = self.offset(file, range_.start), self.offset(file, range_.end)
        return Span(file.source, min(start, end), max(start, end))

    def start(self, span: Span) -> Position:
        """Line and character where a span begins in its file."""
        source, start, _ = span.absolute
        return position(source, start, self.encoding)

    def range(self, span: Span) -> lsp.Range:
        """Where a span is in its file."""
        return as_range(span, self.encoding)

    def location(self, span: Span) -> lsp.Location | None:
        """A place in a file; None for text that comes with swarmdsl in another form."""
        whole = span.absolute
        if whole.source.path is None:
            return None
        return lsp.Location(uri=self.uri(whole.source.path), range=self.range(whole))

    def tell(self) -> None:
        """Send what is wrong with the files that changed, or of which something else was sent."""
        self.dirty = False
        found: dict[str, list[Diagnostic]] = {}
        for workspace, name, diagnostics in self.models.diagnostics():
            # What concerns no place in a file is told of one that is open.
            for path in [Path(name)] if name else self.models.opened(workspace)[:1]:
                found.setdefault(self.uri(path), []).extend(diagnostics)
        for uri in {**self._told, **found, **dict.fromkeys(self._changed)}:
            now = found.get(uri, [])
            if uri in self._changed or now != self._told.get(uri, []):
                self._publish(uri, now)
        self._changed.clear()
        self._told = {uri: told for uri, told in found.items() if told}

    def _publish(self, uri: str, found: Sequence[Diagnostic]) -> None:
        path = self.path(uri)
        document = self.documents.get(path) if path is not None else None
        self.client.text_document_publish_diagnostics(
            lsp.PublishDiagnosticsParams(
                uri=uri,
                diagnostics=as_findings(found, self.encoding, self.uri),
                version=document.version if document is not None else None,
            )
        )
