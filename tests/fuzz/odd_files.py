"""Files that are no ordinary ones, by what is wrong with them."""

from __future__ import annotations

import os
import socket
from collections.abc import Callable
from pathlib import Path


def _pipe(place: Path) -> None:
    os.mkfifo(place)


def _socket(place: Path) -> None:
    here = Path.cwd()
    os.chdir(place.parent)  # the system takes short names only
    with socket.socket(socket.AF_UNIX) as made:
        made.bind(place.name)
    os.chdir(here)


def _locked(place: Path) -> None:
    place.write_text("package locked\n", encoding="utf-8")
    place.chmod(0)


def _bytes(place: Path) -> None:
    place.write_bytes(bytes(range(256)) * 9)


def _loop(place: Path) -> None:
    place.symlink_to(place)


MAKERS: dict[str, Callable[[Path], None]] = {
    "a pipe": _pipe,
    "a device without end": lambda place: place.symlink_to("/dev/zero"),
    "a full device": lambda place: place.symlink_to("/dev/full"),
    "a null device": lambda place: place.symlink_to("/dev/null"),
    "a socket": _socket,
    "a folder": Path.mkdir,
    "a link to nothing": lambda place: place.symlink_to(place.with_name("nothing")),
    "a link to itself": _loop,
    "a locked file": _locked,
    "an empty file": Path.touch,
    "bytes": _bytes,
    "memory of a process": lambda place: place.symlink_to("/proc/self/mem"),
    "the root folder": lambda place: place.symlink_to("/"),
}
LONG = "n" * 300


def odd_file(kind: str, place: Path) -> Path:
    """Make a file of a kind at a place; the long name and the file as a folder are elsewhere."""
    if kind == "a long name":
        return place.with_name(f"{LONG}{place.suffix}")
    if kind == "below a file":
        above = place.with_name(f"{place.name}.file")
        above.touch()
        return above / place.name
    MAKERS[kind](place)
    return place


KINDS = (*MAKERS, "a long name", "below a file")
ENDLESS = ("a pipe", "a device without end", "a full device", "a socket", "memory of a process")
