"""Queue of messages, processed one after the other; rejects invalid ones.

pygls does framing, JSON-RPC and dispatch, and processes each message as soon as it is read. Here a
thread reads all messages into a queue. So a request can be cancelled while another one is answered,
and after many edits in a row only the last text is checked.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Iterable
from dataclasses import dataclass
from queue import Queue
from typing import Any, Protocol

from lsprotocol import types as lsp
from pygls.exceptions import (
    JsonRpcException,
    JsonRpcInvalidRequest,
    JsonRpcParseError,
    JsonRpcRequestCancelled,
    JsonRpcServerNotInitialized,
)
from pygls.io_ import run
from pygls.protocol import LanguageServerProtocol, lsp_method

from swarmdsl.ide.server.io import Incoming

# A client that sends faster than the server answers has to wait.
_QUEUE_SIZE = 256
# Errors are sent to the client, internal errors also to the log of the server.
logging.getLogger("pygls").setLevel(logging.CRITICAL + 1)


@dataclass(frozen=True)
class InvalidMessage:
    """Input that is no valid message."""

    error: JsonRpcException
    id: Any = None
    method: Any = None
    expects_response: bool = True


class DocumentListener(Protocol):
    """Receives changes of open documents."""

    def did_open(self, document: lsp.TextDocumentItem) -> None:
        """Add a document."""

    def did_change(
        self,
        document: lsp.VersionedTextDocumentIdentifier,
        changes: Iterable[lsp.TextDocumentContentChangeEvent],
    ) -> None:
        """Change the text of a document."""

    def did_close(self, document: lsp.TextDocumentIdentifier) -> None:
        """Drop a document."""


class SessionServer(Protocol):
    """Server of a `SerialProtocol`."""

    @property
    def session(self) -> DocumentListener:
        """Listener of the documents."""

    def log(self, message: str) -> None:
        """Send an error message to the client."""


class SerialProtocol(LanguageServerProtocol):
    """Processes messages strictly in order."""

    # The class of the server cannot be named here: it would close an import cycle.
    _server: SessionServer  # type: ignore[assignment]

    def __init__(self, *arguments: Any) -> None:
        # Set before super().__init__(): pygls inspects all attributes for handlers.
        self._received: Queue[Any] = Queue(_QUEUE_SIZE)
        self._cancelled: set[int | str] = set()
        self._initialized = False
        super().__init__(*arguments)

    @property
    def exit_code(self) -> int:
        """Exit code of the protocol: 0 after a `shutdown` request, else 1."""
        return 0 if self._shutdown else 1

    def listen(self, incoming: Incoming) -> None:
        """Start a thread that reads messages."""
        threading.Thread(target=self._listen, args=(incoming,), daemon=True).start()

    def _listen(self, incoming: Incoming) -> None:
        run(threading.Event(), incoming, self, error_handler=self._report_parse_error)
        self._received.put(None)

    def _report_parse_error(self, error: Exception, _source: object) -> None:
        self._received.put(InvalidMessage(JsonRpcParseError(f"invalid JSON: {error}")))

    def structure_message(self, data: dict[str, Any]) -> Any:
        """Return the message, or an InvalidMessage if it has the wrong form."""
        try:
            return super().structure_message(data)
        except JsonRpcException as error:
            return InvalidMessage(error, data.get("id"), data.get("method"), "id" in data)

    def handle_message(self, message: Any) -> None:
        """Queue a message; note cancellations at once."""
        if isinstance(message, lsp.CancelNotification):
            if not self.idle:
                self._cancelled.add(message.params.id)
        elif isinstance(message, InvalidMessage) or hasattr(message, "jsonrpc"):
            self._received.put(message)
        else:
            self._received.put(InvalidMessage(JsonRpcInvalidRequest("not a message of JSON-RPC")))

    def receive(self, timeout: float) -> Any:
        """Return the next message, None at the end of input.

        Raises: queue.Empty after `timeout` seconds.
        """
        return self._received.get(timeout=timeout)

    @property
    def idle(self) -> bool:
        """Return True if no message waits."""
        return self._received.empty()

    def process(self, message: Any) -> None:
        """Process a message. Raises SystemExit on `exit`."""
        is_request = isinstance(message, InvalidMessage) or hasattr(message, "method")
        method, identity = getattr(message, "method", None), getattr(message, "id", None)
        rejection = self._rejection(method, identity) if is_request and method is not None else None
        if isinstance(message, InvalidMessage):
            self._reject(message, rejection or message.error)
        elif rejection is None:
            self._initialized |= method == lsp.INITIALIZE
            super().handle_message(message)
        elif identity is not None:
            self._send_response(identity, error=rejection.to_response_error())
        if self.idle:
            self._cancelled.clear()

    def _rejection(self, method: str, identity: object) -> JsonRpcException | None:
        """Return the reason to reject a message at this time, if any."""
        if method == lsp.EXIT:
            return None
        if method == lsp.INITIALIZE:
            again = JsonRpcInvalidRequest("the server is already initialized")
            return again if self._initialized else None
        if not self._initialized or self._shutdown:
            return JsonRpcServerNotInitialized("the server is not initialized or was shut down")
        cancelled = isinstance(identity, (int, str)) and identity in self._cancelled
        return JsonRpcRequestCancelled("cancelled") if cancelled else None

    def _reject(self, invalid: InvalidMessage, error: JsonRpcException) -> None:
        if invalid.expects_response:
            identity = invalid.id if isinstance(invalid.id, (int, str)) else None
            # JSON-RPC has null for a request without a valid one.
            self._send_response(identity, error=error.to_response_error())  # type: ignore[arg-type]
        else:
            self._server.log(f"{invalid.method}: {error}")

    @lsp_method(lsp.TEXT_DOCUMENT_DID_OPEN)
    def lsp_text_document__did_open(self, params: lsp.DidOpenTextDocumentParams) -> None:
        """Add an opened document. pygls would split its lines like `str.splitlines`."""
        self._server.session.did_open(params.text_document)

    @lsp_method(lsp.TEXT_DOCUMENT_DID_CHANGE)
    def lsp_text_document__did_change(self, params: lsp.DidChangeTextDocumentParams) -> None:
        """Apply all changes of a notification."""
        self._server.session.did_change(params.text_document, params.content_changes)

    @lsp_method(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def lsp_text_document__did_close(self, params: lsp.DidCloseTextDocumentParams) -> None:
        """Drop a closed document; use the file on disk."""
        self._server.session.did_close(params.text_document)
