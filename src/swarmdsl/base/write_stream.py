"""Write a file piece by piece, while a program runs."""

from __future__ import annotations

import io
import os
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from swarmdsl.base.read_files import require_regular

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer

    from swarmdsl.base.diagnostics.collector import Diagnostics


def write_stream(path: Path) -> TextIO:
    """Open a regular file for text that replaces what is in it. Raises OSError.

    A pipe would wait for a reader, and a device is there by mistake. The `filename` of an OSError
    is the path, later too.
    """
    try:
        require_regular(path, os.stat(path).st_mode)  # noqa: PTH116 - takes any path
    except FileNotFoundError:
        pass
    except ValueError as error:
        raise OSError(0, str(error), str(path)) from error
    flags = os.O_WRONLY | os.O_CREAT | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    file = _NamedFile(os.open(path, flags, 0o666), path)
    try:
        require_regular(path, os.fstat(file.fileno()).st_mode)
        file.truncate(0)
    except OSError:
        file.close()
        raise
    return io.TextIOWrapper(io.BufferedWriter(file), encoding="utf-8", newline="\n")


def report_unwritten(path: Path, error: OSError, report: Diagnostics) -> None:
    """Report a file that cannot be written."""
    reason = error.strerror or str(error)
    report.report("cannot-write", path=path, reason=reason[:1].lower() + reason[1:])


class _NamedFile(io.FileIO):
    """File that is named in its errors."""

    def __init__(self, descriptor: int, path: Path) -> None:
        super().__init__(descriptor, "w")
        self._path = str(path)

    def truncate(self, size: int | None = None) -> int:
        try:
            return super().truncate(size)
        except OSError as error:
            raise self._named(error) from error

    def write(self, data: ReadableBuffer) -> int:
        try:
            return super().write(data)
        except OSError as error:
            raise self._named(error) from error

    def _named(self, error: OSError) -> OSError:
        return OSError(error.errno, error.strerror, self._path)
