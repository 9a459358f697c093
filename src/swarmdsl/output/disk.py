"""Access to the files of an output folder."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import (
    MOST_RECORDED,
    OddFileError,
    exists,
    is_file,
    is_folder,
    read_file,
)

_CACHES = ("__pycache__",)

_RIGHTS = "change its permissions, or build into another folder with `-o`"
_FIXES = {
    errno.EACCES: _RIGHTS,
    errno.EPERM: _RIGHTS,
    errno.EROFS: _RIGHTS,
    errno.ENOSPC: "free disk space, and build again",
    errno.EDQUOT: "free disk space, and build again",
    errno.EIO: "check the disk, and build again",
    errno.ENAMETOOLONG: "give the element of the model a shorter name",
}

# Nothing can be there, so that nothing can be written there.
_NO_PLACE = (errno.ENOTDIR, errno.ELOOP, errno.ENAMETOOLONG)


class UnreadableError(OSError):
    """A file or folder that may not be read."""


class Disk:
    """Files of an output folder; paths are relative to it."""

    def __init__(self, out: Path) -> None:
        self.out = out
        self._out = str(out)
        self._inside: dict[str, bool] = {}

    def place(self, path: str) -> str:
        """Return the path of a file on disk.

        A string, because each file is looked up several times and a `Path` is slower to create
        than the lookup.
        """
        return os.path.join(self._out, path)  # noqa: PTH118

    def leads_inside(self, path: str) -> bool:
        """Return True if no symbolic link on the path leads out of the output folder."""
        place = self.place(path)
        if os.path.islink(place):  # noqa: PTH114 - no error for a name that the disk does not take
            return self._is_inside(place)
        folder = os.path.dirname(place)  # noqa: PTH120
        if folder not in self._inside:
            self._inside[folder] = self._is_inside(folder)
        return self._inside[folder]

    def _is_inside(self, place: str | Path) -> bool:
        # `Path.resolve` raises an error for cyclic links.
        return Path(os.path.realpath(place)).is_relative_to(self._real)

    @cached_property
    def _real(self) -> str:
        return os.path.realpath(self.out)

    def content(self, path: str) -> bytes | None:
        """Return the content of a file, None if there is none.

        Raises OSError if it is not a regular file, UnreadableError if it cannot be read.
        """
        place = self.place(path)
        try:
            return read_file(place, MOST_RECORDED)
        except FileNotFoundError:
            return None
        except OddFileError as error:
            raise OSError(0, error.strerror, str(Path(place))) from error
        except OSError as error:
            if error.errno in _NO_PLACE:
                raise
            raise _unreadable(error) from error

    def mode(self, path: str) -> int:
        """Return the permissions of an existing file."""
        return stat.S_IMODE((self.out / path).stat().st_mode)

    def is_executable(self, path: str) -> bool:
        """Return True if the file is executable."""
        return os.access(self.out / path, os.X_OK)

    def same(self, path: str, other: str) -> bool:
        """Return True if two paths are the same file, on case-insensitive file systems."""
        return (self.out / path).samefile(self.out / other)

    def is_link(self, path: str) -> bool:
        """Return True for a symbolic link."""
        return (self.out / path).is_symlink()

    def link_outside(self, path: str) -> Path:
        """Return the symbolic link on a path that leads out of the output folder."""
        way = (self.out / path, *(self.out / path).parents)
        links = (place for place in reversed(way) if place.is_symlink())
        return next((link for link in links if not self._is_inside(link)), self.out / path)

    def obstacle(self, path: str) -> Path:
        """Return the file at a place where a path needs a folder."""
        above = (self.out / path).parents
        return next(place for place in above if exists(place) and not is_folder(place))

    def files(self, folder: str) -> Iterator[str]:
        """Yield regular files below a folder, without Python caches.

        Raises UnreadableError.
        """
        for place, folders, names in os.walk(self.out / folder, onerror=_raise_unreadable):
            folders[:] = sorted(name for name in folders if name not in _CACHES)
            for name in sorted(names):
                found = Path(place, name)
                if is_file(found) and not found.is_symlink():
                    yield found.relative_to(self.out).as_posix()

    def remove(self, path: str) -> None:
        """Remove a file, and the folders that it leaves empty."""
        place = self.out / path
        place.unlink(missing_ok=True)
        for folder in place.parents:
            if folder == self.out:
                return
            try:
                folder.rmdir()
            except OSError:
                return  # not empty


def report_os_error(path: Path, error: OSError, report: Diagnostics) -> None:
    """Report an error of the operating system about a file."""
    reason = error.strerror or str(error) or type(error).__name__
    name = "unreadable-file" if isinstance(error, UnreadableError) else "cannot-write"
    help_ = _FIXES.get(error.errno or 0)
    if help_ is None:
        help_ = "move away what is there, or build into another folder with `-o`"
    place = error.filename or str(path)
    report.report(name, path=place, reason=reason[0].lower() + reason[1:], help=help_)


def _unreadable(error: OSError) -> UnreadableError:
    return UnreadableError(error.errno, error.strerror, error.filename)


def _raise_unreadable(error: OSError) -> None:
    if not isinstance(error, FileNotFoundError):
        raise _unreadable(error)
