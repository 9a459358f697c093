"""Start the debug adapter on byte streams."""

from __future__ import annotations

import gc
import signal
from typing import BinaryIO

from swarmdsl.ide.debugger.messages import Connection
from swarmdsl.ide.debugger.session import Session
from swarmdsl.ide.server.io import Incoming, Outgoing


def serve(reader: BinaryIO, writer: BinaryIO) -> int:
    """Serve a client until it disconnects; return the exit code."""
    if hasattr(signal, "SIGPIPE"):
        # A closed connection is detected at the next write.
        signal.signal(signal.SIGPIPE, signal.SIG_IGN)
    # The compiler disables garbage collection, but a session may be long.
    gc.enable()
    Session(Connection(Incoming(reader), Outgoing(writer))).serve()
    return 0
