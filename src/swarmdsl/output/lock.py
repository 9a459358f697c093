"""Lock an output folder against concurrent builds."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
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


def _locked(folder: Path) -> int | None:
    if sys.platform == "win32":
        return None
    import fcntl

    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
        with suppress(OSError):  # unsupported by some network file systems
            fcntl.flock(handle, fcntl.LOCK_EX)
        return handle
    return None
