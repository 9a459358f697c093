"""The order in which messages are taken, and what becomes of those that are none.

Framing, JSON-RPC and the meaning of messages are those of pygls, which takes each message as soon
as it is read. Here all are read at once and taken one after the other, so that a request can be
cancelled while another one is answered, and so that what waits is known: after many keys in a row
only the last text is looked at.
"""

from __future__ import annotations

import logging
import threading
from dataclasses import dataclass
from queue import Queue
from typing import TYPE_CHECKING, Any

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

if TYPE_CHECKING:
    from swarmdsl.ide.server.server import Server

# A client that sends more than is answered waits.
_MOST_WAITING = 256
# What goes wrong is told to the client, and a mistake of the server itself also to its log.
logging.getLogger("pygls").setLevel(logging.CRITICAL + 1)


@dataclass(frozen=True)
class Fault:
    """What came in place of a message."""

    error: JsonRpcException
    id: Any = None
    method: Any = None
    wants_answer: bool = True


class Conversation(LanguageServerProtocol):
    """Takes messages one after the other, each with all its consequences."""

    _server: Server

    def __init__(self, *arguments: Any) -> None:
        # Before all else: pygls looks at each attribute for the messages that it is about.
        self._received: Queue[Any] = Queue(_MOST_WAITING)
        self._cancelled: set[int | str] = set()
        self._initialized = False
        super().__init__(*arguments)

    @property
    def exit_code(self) -> int:
        """That of a server whose client is gone: 0 if it has said so before."""
        return 0 if self._shutdown else 1

    def listen(self, incoming: Incoming) -> None:
        """Begin to read messages, while others are answered."""
        threading.Thread(target=self._listen, args=(incoming,), daemon=True).start()

    def _listen(self, incoming: Incoming) -> None:
        run(threading.Event(), incoming, self, error_handler=self._not_json)
        self._received.put(None)

    def _not_json(self, error: Exception, _source: object) -> None:
        self._received.put(Fault(JsonRpcParseError(f"this is not JSON: {error}")))

    def structure_message(self, data: dict[str, Any]) -> Any:
        """A message of the protocol, or what is wrong with one that has not its form."""
        try:
            return super().structure_message(data)
        except JsonRpcException as error:
            return Fault(error, data.get("id"), data.get("method"), "id" in data)

    def handle_message(self, message: Any) -> None:
        """Keep a message until those before it are answered."""
        if isinstance(message, lsp.CancelNotification):
            if not self.idle:
                self._cancelled.add(message.params.id)
        elif isinstance(message, Fault) or hasattr(message, "jsonrpc"):
            self._received.put(message)
        else:
            self._received.put(Fault(JsonRpcInvalidRequest("this is no message")))

    def receive(self, timeout: float) -> Any:
        """The next message, None where the client is gone; raises queue.Empty."""
        return self._received.get(timeout=timeout)

    @property
    def idle(self) -> bool:
        """Whether nothing was received that waits to be answered."""
        return self._received.empty()

    def take(self, message: Any) -> None:
        """Do what a message asks for; raises SystemExit where it asks for that."""
        asks = isinstance(message, Fault) or hasattr(message, "method")
        method, identity = getattr(message, "method", None), getattr(message, "id", None)
        refused = self._refused(method, identity) if asks and method is not None else None
        if isinstance(message, Fault):
            self._refuse(message, refused or message.error)
        elif refused is None:
            self._initialized |= method == lsp.INITIALIZE
            super().handle_message(message)
        elif identity is not None:
            self._send_response(identity, error=refused.to_response_error())
        if self.idle:
            self._cancelled.clear()

    def _refused(self, method: str, identity: object) -> JsonRpcException | None:
        """Why a request is not answered, or a notification not heard, at this time."""
        if method == lsp.EXIT:
            return None
        if method == lsp.INITIALIZE:
            again = JsonRpcInvalidRequest("the server is initialized already")
            return again if self._initialized else None
        if not self._initialized or self._shutdown:
            return JsonRpcServerNotInitialized("the server is not initialized, or shut down")
        cancelled = isinstance(identity, (int, str)) and identity in self._cancelled
        return JsonRpcRequestCancelled("cancelled") if cancelled else None

    def _refuse(self, fault: Fault, error: JsonRpcException) -> None:
        if fault.wants_answer:
            identity = fault.id if isinstance(fault.id, (int, str)) else None
            self._send_response(identity, error=error.to_response_error())  # type: ignore[arg-type]
        else:
            self._server.log(f"{fault.method}: {error}")

    @lsp_method(lsp.TEXT_DOCUMENT_DID_OPEN)
    def lsp_text_document__did_open(self, params: lsp.DidOpenTextDocumentParams) -> None:
        """Take a text that the client shows. Those of pygls end lines where Python does."""
        self._server.session.opened(params.text_document)

    @lsp_method(lsp.TEXT_DOCUMENT_DID_CHANGE)
    def lsp_text_document__did_change(self, params: lsp.DidChangeTextDocumentParams) -> None:
        """Take what the client has changed in one."""
        self._server.session.changed(params.text_document, params.content_changes)

    @lsp_method(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def lsp_text_document__did_close(self, params: lsp.DidCloseTextDocumentParams) -> None:
        """Take what is on disk again."""
        self._server.session.closed(params.text_document)
