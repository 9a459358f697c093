"""One build at a time in an output folder."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Wait until no other build writes to a folder, and let none begin meanwhile.

    The system ends the lock with the process, however that ends. Where it has no such locks, as
    Windows, or there is no folder, nothing is locked.
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
        with suppress(OSError):  # some file systems of networks
            fcntl.flock(handle, fcntl.LOCK_EX)
        return handle
    return None
