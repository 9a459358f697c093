"""Messages between a client and the server, as JSON with a header each.

Source: LSP 3.17, "Base Protocol"; JSON-RPC 2.0. It is not that of `pygls`, which takes longer to
import (`lsprotocol`) than a whole model takes to be checked.
"""

from __future__ import annotations

import json
import re
import threading
from queue import Empty, Queue
from typing import Any, Protocol

Json = dict[str, Any]

PARSE_ERROR = -32700
INVALID_REQUEST = -32600
METHOD_NOT_FOUND = -32601
INVALID_PARAMS = -32602
INTERNAL_ERROR = -32603
NOT_INITIALIZED = -32002
REQUEST_FAILED = -32803
CANCELLED = -32800

# A model of a million lines is smaller; what claims to be longer is no message.
_MOST_BYTES = 2**28
_MOST_HEADER = 2**14
_CHUNK = 2**16
# A client that sends more than is answered waits.
_MOST_WAITING = 256
_LENGTH = re.compile(rb"^content-length:[ \t]*(\d{1,12})[ \t]*$", re.IGNORECASE | re.MULTILINE)


class Reader(Protocol):
    """A stream that gives what has arrived, at most as many bytes as asked for."""

    def read(self, size: int, /) -> bytes | None:
        """Some bytes, none at the end."""


class Writer(Protocol):
    """A stream that takes bytes."""

    def write(self, data: bytes, /) -> int | None:
        """Take all of them, or say how many were."""


class RequestError(Exception):
    """Why a request is not answered: a code of the protocol, and words for a person."""

    def __init__(self, code: int, message: str) -> None:
        super().__init__(message)
        self.code = code


class Connection:
    """Sends and receives messages; they are received while others are answered."""

    def __init__(self, reader: Reader, writer: Writer) -> None:
        self._reader = reader
        self._writer = writer
        self._received: Queue[Any] = Queue(_MOST_WAITING)
        self._buffer = b""
        self.cancelled: set[int | str] = set()
        threading.Thread(target=self._receive_all, daemon=True).start()

    def receive(self, timeout: float | None = None) -> Any:
        """The next message, None where the client is gone; raises TimeoutError.

        What is no JSON is a RequestError, to be answered.
        """
        try:
            return self._received.get(timeout=timeout)
        except Empty:
            raise TimeoutError from None

    @property
    def idle(self) -> bool:
        """Whether nothing was received that waits to be answered."""
        return self._received.empty()

    def send(self, message: Json) -> None:
        """Send a message; raises OSError where the client is gone."""
        content = json.dumps({"jsonrpc": "2.0", **message}, separators=(",", ":")).encode()
        data = memoryview(b"Content-Length: %d\r\n\r\n%s" % (len(content), content))
        while data:
            data = data[self._writer.write(data) or 0 :]  # type: ignore[arg-type]

    def _receive_all(self) -> None:
        try:
            while (content := self._next()) is not None:
                try:
                    message = json.loads(content)
                except (ValueError, RecursionError) as error:
                    message = RequestError(PARSE_ERROR, f"this is not JSON: {error}")
                if isinstance(message, dict) and message.get("method") == "$/cancelRequest":
                    self._cancel(message.get("params"))
                elif message is not None:
                    self._received.put(message)
        except (OSError, ValueError):
            pass  # the client is gone, or speaks another language
        self._received.put(None)

    def _cancel(self, params: object) -> None:
        wanted = params.get("id") if isinstance(params, dict) else None
        if isinstance(wanted, (int, str)) and not self.idle:
            self.cancelled.add(wanted)

    def _next(self) -> bytes | None:
        """The content of the next message, None at the end of the stream."""
        while True:
            while b"\r\n\r\n" not in self._buffer:
                if len(self._buffer) > _MOST_HEADER or not self._read_on(_CHUNK):
                    return None
            header, _, self._buffer = self._buffer.partition(b"\r\n\r\n")
            length = _LENGTH.search(header.replace(b"\r\n", b"\n"))
            if length is not None:
                break
        size = int(length[1])
        if size > _MOST_BYTES:
            return None
        parts, count = [self._buffer], len(self._buffer)
        while count < size:
            part = self._reader.read(max(size - count, 1))
            if not part:
                return None
            parts.append(part)
            count += len(part)
        whole = b"".join(parts)
        self._buffer = whole[size:]
        return whole[:size]

    def _read_on(self, size: int) -> bool:
        part = self._reader.read(size)
        self._buffer += part or b""
        return bool(part)
