"""Starts the server; what it is made of is imported then."""

from __future__ import annotations

import os
import signal
from typing import BinaryIO, cast


def serve(reader: BinaryIO, writer: BinaryIO) -> int:
    """Serve a client until it is gone; return the exit code."""
    if hasattr(signal, "SIGPIPE"):
        # An editor that is gone is noticed where something is written.
        signal.signal(signal.SIGPIPE, signal.SIG_IGN)
    from swarmdsl.ide.server import lazy_lsp_types

    lazy_lsp_types.load()
    from swarmdsl.ide.server import server

    return server.serve(reader, writer)


def serve_on_standard_streams() -> int:
    """Serve the client that has started this process; return the exit code."""
    return serve(_taken(0, "rb"), _taken(1, "wb"))


def _taken(descriptor: int, mode: str) -> BinaryIO:
    """A standard stream; what is printed by mistake does not get into it."""
    stream = os.fdopen(os.dup(descriptor), mode)
    null = os.open(os.devnull, os.O_RDWR)
    os.dup2(null, descriptor)
    os.close(null)
    return cast(BinaryIO, stream)
