"""Byte streams from and to the client, with limits."""

from __future__ import annotations

import re
from typing import BinaryIO

# A model of a million lines is smaller; longer input is no valid message.
_MAX_BYTES = 2**28
_MAX_HEADER = 2**14
_LENGTH = re.compile(rb"content-length:[ \t]*(\d+)[ \t]*\r?\n", re.IGNORECASE)


class Incoming:
    """Input of a client; reads as empty after errors and invalid framing."""

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream

    def readline(self) -> bytes:
        """Return a header line, or nothing at the end."""
        try:
            line = self._stream.readline(_MAX_HEADER)
        except OSError:
            return b""
        length = _LENGTH.fullmatch(line)
        if length is not None:  # pygls accepts only one spelling of the header
            return b"Content-Length: %s\r\n" % length[1]
        return line if line.endswith(b"\n") else b""

    def read(self, size: int) -> bytes:
        """Return the content of a message, or nothing at the end."""
        try:
            return self._stream.read(size) if size <= _MAX_BYTES else b""
        except OSError:
            return b""


class Outgoing:
    """Output to a client; `gone` is True once the connection is broken."""

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream
        self.gone = False

    def write(self, data: bytes) -> None:
        """Write all data and flush."""
        try:
            self._stream.write(data)
            self._stream.flush()
        except OSError:
            self.gone = True

    def close(self) -> None:
        """Do nothing: all data is flushed, and the owner closes the stream."""
