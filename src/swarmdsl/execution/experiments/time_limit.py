"""Limit the time of a call in the thread that makes it."""

from __future__ import annotations

import ctypes
import faulthandler
import os
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Lock, Timer, get_ident

GRACE = 2.0
"""Seconds that a call has to end after its time is over."""
_deadly = False


class OverdueError(BaseException):
    """The time of a call is over.

    Not an `Exception`: code of others that does not end may catch those.
    """


@contextmanager
def deadly(is_deadly: bool) -> Iterator[None]:
    """Let blocks with a limit end this process where Python cannot interrupt them."""
    global _deadly  # one task at a time
    _deadly = is_deadly
    try:
        yield
    finally:
        _deadly = False


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Raise OverdueError in this thread if the block does not end in time.

    A call that Python cannot interrupt, of a library in C, goes on to its end first, except in
    `deadly`: there its process ends.
    """
    if not _deadly:
        with _interrupted(seconds):
            yield
        return
    # Its thread needs no lock of the interpreter, which a call in C may hold for ever.
    with open(os.devnull, "wb") as nowhere:  # noqa: PTH123
        faulthandler.dump_traceback_later(seconds + GRACE, file=nowhere, exit=True)
        try:
            with _interrupted(seconds):
                yield
        finally:
            faulthandler.cancel_dump_traceback_later()


@contextmanager
def _interrupted(seconds: float) -> Iterator[None]:
    """Raise OverdueError in this thread if the block does not end in time."""
    thread, lock = get_ident(), Lock()
    is_over = False

    def interrupt() -> None:
        with lock:
            if not is_over:
                raised = ctypes.py_object(OverdueError)
                ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), raised)

    timer = Timer(seconds, interrupt)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        with lock:
            is_over = True
        timer.cancel()
