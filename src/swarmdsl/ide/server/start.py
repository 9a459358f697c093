"""Start the server; import its parts on demand."""

from __future__ import annotations

import os
import signal
from typing import BinaryIO, cast


def serve(reader: BinaryIO, writer: BinaryIO) -> int:
    """Serve a client until it disconnects; return the exit code."""
    if hasattr(signal, "SIGPIPE"):
        # A closed connection is detected at the next write.
        signal.signal(signal.SIGPIPE, signal.SIG_IGN)
    from swarmdsl.ide.server import lazy_lsp_types

    lazy_lsp_types.load()
    from swarmdsl.ide.server import server

    return server.serve(reader, writer)


def serve_on_standard_streams() -> int:
    """Serve the parent process on stdin and stdout; return the exit code."""
    return serve(*standard_streams())


def standard_streams() -> tuple[BinaryIO, BinaryIO]:
    """Return stdin and stdout for messages; nothing else can read or write them any more."""
    return _take_over(0, "rb"), _take_over(1, "wb")


def _take_over(descriptor: int, mode: str) -> BinaryIO:
    """Duplicate a standard stream; redirect the original to null against stray prints."""
    stream = os.fdopen(os.dup(descriptor), mode)
    null = os.open(os.devnull, os.O_RDWR)
    os.dup2(null, descriptor)
    os.close(null)
    return cast(BinaryIO, stream)
