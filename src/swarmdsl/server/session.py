"""What the server knows of its client: the files it has open, and what it was told of them."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from urllib.parse import unquote_to_bytes, urlsplit

from swarmdsl.diagnostics import Diagnostic
from swarmdsl.load import File
from swarmdsl.server.connection import INVALID_PARAMS, Connection, Json, RequestError
from swarmdsl.server.documents import Document
from swarmdsl.server.findings import as_findings, as_range
from swarmdsl.server.models import Models
from swarmdsl.server.positions import offset
from swarmdsl.server.tokens import Painter
from swarmdsl.source import Span
from swarmdsl.workspace import Workspace

Place = tuple[Workspace, File, int]

# Those that the server can count in, by preference.
_ENCODINGS = ("utf-32", "utf-8", "utf-16")
_ERROR = 1


class Session:
    """A client, its files and models; answers are made of it."""

    def __init__(self, connection: Connection) -> None:
        self.connection = connection
        self.models = Models()
        self.encoding = "utf-16"
        self.capabilities: Json = {}
        # The commands of its own that the client offers to be named.
        self.commands: frozenset[str] = frozenset()
        self.documents: dict[Path, Document] = {}
        self.painter = Painter()
        self._uris: dict[Path, str] = {}
        self._told: dict[str, list[Diagnostic]] = {}
        self._changed: set[str] = set()
        self._requests = 0

    def agree(self, capabilities: Any) -> str:
        """Take what a client can do; return in which units it will count characters."""
        self.capabilities = capabilities if isinstance(capabilities, dict) else {}
        offered = self.offers("general", "positionEncodings")
        wanted = offered if isinstance(offered, list) else []
        self.encoding = next((each for each in _ENCODINGS if each in wanted), "utf-16")
        return self.encoding

    def take_options(self, options: Any) -> None:
        """Take what a client says of itself beyond the protocol."""
        commands = options.get("commands") if isinstance(options, dict) else None
        known = commands if isinstance(commands, list) else []
        self.commands = frozenset(each for each in known if isinstance(each, str))

    def offers(self, *names: str) -> Any:
        """What the client says of one of its capabilities; None where it says nothing."""
        found: Any = self.capabilities
        for name in names:
            found = found.get(name) if isinstance(found, dict) else None
        return found

    def path(self, uri: Any) -> Path | None:
        """The file that a client names; None for what is no file."""
        if not isinstance(uri, str):
            raise RequestError(INVALID_PARAMS, "a URI is missing")
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

    def open(self, path: Path, uri: str, document: Document) -> None:
        """Take a file for one that the client shows."""
        self._uris[path] = uri
        self.documents[path] = document
        self.edit(path)

    def edit(self, path: Path) -> None:
        """Take the text of a document as it is now."""
        self._changed.add(self.uri(path))
        self.models.edit(path, self.documents[path].text)

    def close(self, path: Path) -> None:
        """Take what is on disk for a file again."""
        self._changed.discard(self._uris.pop(path, ""))
        if self.documents.pop(path, None) is not None:
            self.models.close(path)
            self.painter.forget(str(path))

    def file(self, params: Json) -> tuple[Workspace, File] | None:
        """The open file that a request is about, and the model that it belongs to."""
        document = params.get("textDocument")
        if not isinstance(document, dict):
            raise RequestError(INVALID_PARAMS, "the document is missing")
        path = self.path(document.get("uri"))
        return self.models.file(path) if path is not None else None

    def place(self, params: Json) -> Place | None:
        """The position that a request is about."""
        found = self.file(params)
        at = params.get("position")
        where = self.offset(found[1] if found is not None else None, at)
        return (*found, where) if found is not None else None

    def place_on_disk(self, uri: Any, at: Any) -> Place | None:
        """A position in a file that need not be open, if a model has it."""
        path = self.path(uri)
        for workspace in self.models.all() if path is not None else ():
            file = workspace.file(path) if path is not None else None
            if file is not None:
                return workspace, file, self.offset(file, at)
        return None

    def offset(self, file: File | None, at: Any) -> int:
        """The offset of a position in a file."""
        line = at.get("line") if isinstance(at, dict) else None
        character = at.get("character") if isinstance(at, dict) else None
        if not isinstance(line, int) or not isinstance(character, int):
            raise RequestError(INVALID_PARAMS, "the position is missing")
        return offset(file.source, (line, character), self.encoding) if file is not None else 0

    def span(self, file: File, range_: Any) -> Span:
        """A part of a file that a request is about."""
        ends = range_ if isinstance(range_, dict) else {}
        start, end = (self.offset(file, ends.get(name)) for name in ("start", "end"))
        return Span(file.source, min(start, end), max(start, end))

    def range(self, span: Span) -> Json:
        """Where a span is in its file."""
        return as_range(span, self.encoding)

    def location(self, span: Span) -> Json | None:
        """A place in a file; None for text that comes with swarmdsl in another form."""
        whole = span.absolute
        if whole.source.path is None:
            return None
        return {"uri": self.uri(whole.source.path), "range": self.range(whole)}

    def notify(self, method: str, params: Json) -> None:
        """Tell the client something."""
        self.connection.send({"method": method, "params": params})

    def log(self, message: str) -> None:
        """Tell of a mistake in what the client said, or in the server."""
        self.notify("window/logMessage", {"type": _ERROR, "message": message})

    def ask(self, method: str, params: Json | None) -> None:
        """Ask the client for something; what it answers is of no interest."""
        self._requests += 1
        self.connection.send({"id": self._requests, "method": method, "params": params})

    def tell(self) -> None:
        """Send what is wrong with the files that changed, or of which something else was sent."""
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
        findings = as_findings(found, self.encoding, self.uri)
        message: Json = {"uri": uri, "diagnostics": findings}
        path = self.path(uri)
        document = self.documents.get(path) if path is not None else None
        if document is not None and document.version is not None:
            message["version"] = document.version
        self.notify("textDocument/publishDiagnostics", message)
