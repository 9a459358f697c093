"""Limit the time of a call in the thread that makes it."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Lock, Timer, get_ident


class OverdueError(BaseException):
    """The time of a call is over.

    Not an `Exception`: code of others that does not end may catch those.
    """


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Raise OverdueError in this thread if the block does not end in time.

    A call that Python cannot interrupt, of a library in C, goes on to its end first.
    """
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
