"""Replace many files together: write all of them first, then move them in place."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from itertools import takewhile
from pathlib import Path
from types import TracebackType

from swarmdsl.base.read_files import exists


class Staging:
    """Files written next to their final place, under unique names.

    Leaving the context removes those not moved in place, and folders made for them. The `filename`
    of an OSError is the final path.
    """

    def __init__(self) -> None:
        self._staged: dict[Path, Path] = {}
        self._folders: list[Path] = []
        self._there: set[Path] = set()
        # No other program has such names, and no other staging.
        self._mark = os.urandom(8).hex()
        self._given = 0

    def add(
        self, path: Path, content: bytes, executable: bool = False, mode: int | None = None
    ) -> None:
        """Write the content of a file next to its place; `mode` replaces the usual permissions."""
        with _blamed_on(path):
            self.make_folder(path.parent)
            with suppress(FileNotFoundError):
                # A name that the disk does not take must fail before any move, and so must a
                # device or pipe: a file in its place would be the end of it for all programs.
                there = path.stat().st_mode
                if not (stat.S_ISREG(there) or stat.S_ISDIR(there)):
                    raise OSError(errno.EINVAL, "it is no regular file")
            # Noted first: it must go also when writing it is interrupted.
            beside = self.beside(path)
            # O_EXCL: never through a link that somebody put there.
            flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
            with os.fdopen(os.open(beside, flags, 0o777 if executable else 0o666), "wb") as file:
                file.write(content)
            if mode is not None:
                beside.chmod(mode)

    def move_in_place(self) -> Iterator[Path]:
        """Replace the files one by one, in the order they were added; yield each path."""
        for path, beside in list(self._staged.items()):
            with _blamed_on(path):
                # `os.replace` is the one move that is atomic on every system.
                os.replace(beside, path)  # noqa: PTH105
            del self._staged[path]
            yield path

    def beside(self, path: Path) -> Path:
        """Return the path of a file's content until it is moved in place."""
        if path not in self._staged:
            self._given += 1
            self._staged[path] = path.with_name(f".swarmc-{self._mark}-{self._given}.tmp")
        return self._staged[path]

    def make_folder(self, folder: Path) -> None:
        """Make a folder, and those above it, where they are missing."""
        if folder in self._there:
            return
        missing = list(takewhile(lambda above: not exists(above), (folder, *folder.parents)))
        for above in reversed(missing):
            above.mkdir(exist_ok=True)
            self._folders.append(above)
        self._there.add(folder)

    def __enter__(self) -> Staging:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        for beside in self._staged.values():
            with suppress(OSError):
                beside.unlink()
        for folder in reversed(self._folders):
            with suppress(OSError):
                folder.rmdir()  # which only an empty one lets happen


@contextmanager
def _blamed_on(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        error.filename, error.filename2 = str(path), None
        raise
