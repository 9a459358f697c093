"""Lock a folder against processes that write there at the same time."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

FILE = ".lock"
"""File in a folder that is locked where the folder cannot be."""

Lock = Callable[[int], None]
"""Locks an open file; raises OSError if another process has locked it."""


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Wait until no other build writes to a folder, and hold the lock meanwhile.

    The system releases the lock when the process ends. Without such locks, as on Windows, or
    without the folder, nothing is locked.
    """
    handle = _locked(folder)
    try:
        yield
    finally:
        if handle is not None:
            os.close(handle)


def lock_now(folder: Path) -> int | None:
    """Lock a folder; return a file descriptor that holds the lock until it is closed.

    None if nothing can be locked there. Raises BlockingIOError if another holds the lock. On
    Windows, which locks no folders, a file in it is locked.
    """
    if sys.platform == "win32":
        import msvcrt

        return lock_file(folder, lambda handle: msvcrt.locking(handle, msvcrt.LK_NBLCK, 1))
    return _locked(folder, is_patient=False)


def _locked(folder: Path, *, is_patient: bool = True) -> int | None:
    if sys.platform == "win32":
        return None
    import fcntl

    try:
        handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    except OSError:
        return None
    try:
        fcntl.flock(handle, fcntl.LOCK_EX if is_patient else fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(handle)
        raise
    except OSError:
        pass  # unsupported by some network file systems
    return handle


def lock_file(folder: Path, lock: Lock) -> int | None:
    """Lock a file in a folder, as `lock_now` does with the folder itself."""
    try:
        # The file stays: to remove it would take the lock from a process that has it open.
        handle = os.open(folder / FILE, os.O_RDWR | os.O_CREAT)
    except OSError:
        return None
    try:
        lock(handle)
    except OSError as error:
        os.close(handle)
        raise BlockingIOError(error.errno, error.strerror) from error
    return handle
