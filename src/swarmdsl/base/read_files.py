"""The one door by which files are read: regular files only, bounded, without blocking.

What a model, a project file or a command line names comes from strangers: it may be a pipe to
which nobody writes, a device without end, or a name that the system does not take. All of that is
an OSError here; `swarmdsl.project.read_source` makes diagnostics of it.
"""

from __future__ import annotations

import errno
import io
import os
import stat
from collections.abc import Callable, Iterator
from pathlib import Path

MOST = 8 * 2**20
"""The largest model."""
MOST_DATA = 2 * 2**20
"""The largest document of XML, JSON, YAML or TOML: their parsers take long and much memory."""
MOST_RECORDED = 256 * 2**20
"""The largest file that a program writes: a trace, a file of events, a list of generated files."""

_KINDS = {
    stat.S_IFDIR: "a folder",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}
_AT_ONCE = 1 << 16
# Windows lacks the first, and needs the second.
_FLAGS = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)


class OddFileError(OSError):
    """A folder, pipe, socket or device where a file is expected; `kind` has its article."""

    def __init__(self, path: str, kind: str) -> None:
        super().__init__(errno.EINVAL, f"it is {kind}, not a regular file", path)
        self.kind = kind


class TooLargeError(OSError):
    """A file that is larger than `most` bytes."""

    def __init__(self, path: str, most: int) -> None:
        super().__init__(errno.EFBIG, f"it is larger than {most // 2**20} MB", path)
        self.most = most


def open_file(path: Path | str) -> io.FileIO:
    """Open a regular file. Raises OSError."""
    try:
        # First without opening: to open a device can have effects.
        require_regular(path, os.stat(path).st_mode)  # noqa: PTH116 - takes strings, which are faster
        file = io.FileIO(os.open(path, _FLAGS))
    except ValueError as error:
        raise OSError(errno.EINVAL, str(error), str(path)) from error
    try:
        require_regular(path, os.fstat(file.fileno()).st_mode)
    except OSError:
        file.close()
        raise
    return file


def read_file(path: Path | str, most: int = MOST) -> bytes:
    """Read a regular file of at most `most` bytes. Raises OSError."""
    with open_file(path) as file:
        size = os.fstat(file.fileno()).st_size
        # Files of the kernel have a size of 0, and others may grow.
        left, pieces = most + 1, []
        while size <= most and left and (piece := file.read(min(left, max(size + 1, _AT_ONCE)))):
            pieces.append(piece)
            left -= len(piece)
    if size > most or not left:
        raise TooLargeError(str(path), most)
    return b"".join(pieces)


def read_text(path: Path) -> str:
    """Read a file that comes with swarmdsl."""
    return read_file(path).decode()


def is_file(path: Path | str) -> bool:
    """Return True for a regular file; False also for a name that the system does not take."""
    return os.path.isfile(path)  # noqa: PTH113 - `Path.is_file` raises an error for long names


def is_folder(path: Path | str) -> bool:
    """Return True for a folder; False also for a name that the system does not take."""
    return os.path.isdir(path)  # noqa: PTH112 - `Path.is_dir` raises an error for long names


def lines_of(read: Callable[[], bytes]) -> Iterator[list[bytes]]:
    """Yield new lines of a stream as they arrive; a line without end is cut at `MOST` bytes."""
    rest = b""
    while chunk := read():
        *lines, rest = (rest + chunk).split(b"\n")
        if len(rest) > MOST:
            lines, rest = [*lines, rest], b""
        yield lines
    if rest:
        yield [rest]


def exists(path: Path | str) -> bool:
    """Return True if something is there; False also for a name that the system does not take."""
    return os.path.exists(path)  # noqa: PTH110 - `Path.exists` raises an error for long names


def require_regular(path: Path | str, mode: int) -> None:
    """Raise OddFileError unless the mode of a file is that of a regular one."""
    if not stat.S_ISREG(mode):
        raise OddFileError(str(path), _KINDS.get(stat.S_IFMT(mode), "no file"))
