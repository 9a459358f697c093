"""The bytes of a client, in lines and pieces that have an end; and those for it."""

from __future__ import annotations

import re
from typing import BinaryIO

# A model of a million lines is smaller; what claims to be longer is no message.
_MOST_BYTES = 2**28
_MOST_HEADER = 2**14
_LENGTH = re.compile(rb"content-length:[ \t]*(\d+)[ \t]*\r?\n", re.IGNORECASE)


class Incoming:
    """What a client sends; nothing more where it is gone, or speaks another language."""

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream

    def readline(self) -> bytes:
        """A line of a header, nothing at the end."""
        try:
            line = self._stream.readline(_MOST_HEADER)
        except OSError:
            return b""
        length = _LENGTH.fullmatch(line)
        if length is not None:  # pygls knows one of the ways in which it can be written
            return b"Content-Length: %s\r\n" % length[1]
        return line if line.endswith(b"\n") else b""

    def read(self, size: int) -> bytes:
        """The content of a message, nothing at the end."""
        try:
            return self._stream.read(size) if size <= _MOST_BYTES else b""
        except OSError:
            return b""


class Outgoing:
    """What a client gets; `gone` once it does not listen any more."""

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream
        self.gone = False

    def write(self, data: bytes) -> None:
        """Send all of it."""
        try:
            self._stream.write(data)
            self._stream.flush()
        except OSError:
            self.gone = True

    def close(self) -> None:
        """End the connection: what was sent is on its way, and its owner closes the stream."""
