"""End of a process some time after a signal, whatever its threads do.

A handler of Python runs in the main thread, which may hang in a library or in a write to a pipe
that nobody reads. Python also writes the number of each signal to a socket at once, and a thread
waits for it there.
"""

from __future__ import annotations

import faulthandler
import os
import signal
import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Thread

_LATE = 15.0
"""Seconds after a signal in which the process has to end."""
_MARGIN = 1.0
_STDERR = 2
"""Not `sys.stderr`, which would be flushed: to a pipe that nobody reads, perhaps."""


@contextmanager
def forced_end() -> Iterator[None]:
    """End the process if it has not ended `_LATE` seconds after a signal in this context.

    The exit code is that of shells for a signal; 1 if a call kept the lock of the interpreter.
    """
    reading, writing = socket.socketpair()
    writing.setblocking(False)
    before = signal.set_wakeup_fd(writing.fileno(), warn_on_full_buffer=False)
    Thread(target=_end_late, args=(reading,), name="forced end", daemon=True).start()
    try:
        yield
    finally:
        signal.set_wakeup_fd(before)
        writing.close()


def _end_late(signals: socket.socket) -> None:
    with signals:
        number = signals.recv(1)
    if not number:  # the context is left without a signal
        return
    # The library may keep the lock of the interpreter, which this thread needs and the other not.
    faulthandler.dump_traceback_later(_LATE + _MARGIN, exit=True, file=_STDERR)
    time.sleep(_LATE)
    os._exit(128 + number[0])
