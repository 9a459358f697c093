"""Lock a folder against processes that write there at the same time."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


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

    None if nothing can be locked there. Raises BlockingIOError if another holds the lock.
    """
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
