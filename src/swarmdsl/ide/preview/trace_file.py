"""Lines of a trace as they are written: of a file that grows, or of standard input."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from enum import Enum
from pathlib import Path
from time import sleep

from swarmdsl.base.read_files import MOST, OddFileError, lines_of, open_file

STDIN = "-"
_POLL_INTERVAL = 0.1
"""Seconds between two polls of a file."""
_CHUNK = 1 << 20


class Turn(Enum):
    """Event in the life of a trace beside its lines."""

    BEGUN = "begun"
    """It is opened, for the first time or again from its beginning."""
    GONE = "gone"
    """The file is no longer there, and may come again."""
    ENDED = "ended"
    """Nothing more will come."""


def read_growing(name: str) -> Iterator[list[bytes] | Turn]:
    """Yield new complete lines of a trace; it never ends for a file.

    Raises OddFileError for a pipe or a device.
    """
    return _stream() if name == STDIN else _chunks(Path(name))


def _chunks(path: Path) -> Iterator[list[bytes] | Turn]:
    was_there = False
    while True:
        try:
            with open_file(path) as file:
                was_there = True
                yield Turn.BEGUN
                yield from _regular(path, file.fileno())
        except OddFileError:
            raise
        except OSError:
            if was_there:
                was_there = False
                yield Turn.GONE
            sleep(_POLL_INTERVAL)


def _regular(path: Path, descriptor: int) -> Iterator[list[bytes]]:
    """Yield lines of a regular file until it is truncated or replaced."""
    rest, at = b"", 0
    while True:
        chunk = os.read(descriptor, _CHUNK)
        at += len(chunk)
        *lines, rest = (rest + chunk).split(b"\n")
        if len(rest) > MOST:
            lines, rest = [*lines, rest], b""
        yield lines
        if not chunk:
            sleep(_POLL_INTERVAL)
            there, here = path.stat(), os.fstat(descriptor)
            if here.st_size < at or (there.st_dev, there.st_ino) != (here.st_dev, here.st_ino):
                return


def _stream() -> Iterator[list[bytes] | Turn]:
    yield Turn.BEGUN
    yield from lines_of(lambda: os.read(sys.stdin.fileno(), _CHUNK))
    yield Turn.ENDED
