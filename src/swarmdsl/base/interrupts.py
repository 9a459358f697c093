"""Signals that end a command, and that Python cannot lose.

Their handlers raise an exception in the main thread. Python drops it if a finalizer is running
there, which the garbage collector can start at any time. Loops that run until a signal ends them
call `raise_lost`.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

_raised: list[BaseException] = []


def install(number: int, error: BaseException) -> None:
    """Raise an exception in the main thread when a signal arrives."""

    def handle(_number: int, _frame: FrameType | None) -> None:
        _raised[:] = [error]
        raise error

    signal.signal(number, handle)


def raise_lost() -> None:
    """Raise the exception of a signal again if it has arrived, but was lost."""
    if _raised:
        raise _raised.pop()


@contextmanager
def first_one(number: int, act: Callable[[], object]) -> Iterator[None]:
    """Call a function when a signal arrives, instead of its handler, which gets the next ones."""
    before = signal.getsignal(number)
    if not callable(before) or threading.current_thread() is not threading.main_thread():
        yield  # ignored, as in `nohup`
        return

    def handle(_number: int, _frame: FrameType | None) -> None:
        signal.signal(number, before)
        act()

    signal.signal(number, handle)
    try:
        yield
    finally:
        signal.signal(number, before)
