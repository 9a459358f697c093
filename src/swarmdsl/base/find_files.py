"""Search of folders, bounded: a project file can name `/`."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Callable, Iterator
from pathlib import Path

MOST_ENTRIES = 100_000
"""The most files and folders that are looked at below a folder."""
MOST_TOGETHER = 16 * 2**20
"""The most bytes of the files that are found below a folder, together."""


class TooManyFilesError(OSError):
    """A folder with more in it than a project has; `strerror` says what."""

    def __init__(self, folder: Path, much: str) -> None:
        super().__init__(errno.EFBIG, f"it has more than {much}", str(folder))


def files_below(folder: Path, ending: str) -> list[Path]:
    """Return the files below a folder with an ending, sorted. Raises TooManyFilesError.

    Folders whose names begin with a dot, such as environments and caches, are skipped, and so are
    files and folders that vanish or cannot be read while another program changes them. Links to
    folders are not followed.
    """
    found, size = [], 0
    for place, folders, names in walk(folder):
        folders[:] = [each for each in folders if not each.startswith(".")]
        for name in names:
            if not name.endswith(ending):
                continue
            try:
                about = os.stat(os.path.join(place, name))  # noqa: PTH116, PTH118 - many files
            except OSError:
                continue
            if stat.S_ISREG(about.st_mode):
                found.append(Path(place, name))
                size += about.st_size
        if size > MOST_TOGETHER:
            raise TooManyFilesError(folder, f"{MOST_TOGETHER // 2**20} MB of {ending} files")
    return sorted(found)


def walk(
    folder: Path, onerror: Callable[[OSError], None] | None = None, *, followlinks: bool = False
) -> Iterator[tuple[str, list[str], list[str]]]:
    """Walk through folders as `os.walk` does. Raises TooManyFilesError."""
    entries = 0
    for place, folders, names in os.walk(folder, onerror=onerror, followlinks=followlinks):
        entries += len(folders) + len(names)
        if entries > MOST_ENTRIES:
            raise TooManyFilesError(folder, f"{MOST_ENTRIES} files and folders")
        yield place, folders, names
