"""User regions of generated files, whose content is kept.

A region is between two comment lines with `swarmc:begin ID` and `swarmc:end ID`, in the language
of the file. The id is that of a model element, so that a region is found wherever it moves.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

Texts = Mapping[str, bytes]
"""User content of each region."""

_MARK = rb"swarmc:(begin|end) ([A-Za-z0-9_.]+)"


class RegionError(Exception):
    """Invalid region marks; `line` counts from 0."""

    def __init__(self, line: int, fault: str) -> None:
        super().__init__(fault)
        self.line, self.fault = line, fault


def fault(content: bytes) -> RegionError | None:
    """Return the fault in the marks of a file, which then has no regions."""
    try:
        _pieces(content)
    except RegionError as error:
        return error
    return None


def generated(content: bytes) -> bytes:
    """Return a file without region contents; all of it if a mark is invalid."""
    return b"".join(b"".join(lines) for id_, lines in _whole(content) if id_ is None)


def kept(content: bytes) -> dict[str, bytes]:
    """Return the content of each region that is not blank."""
    found = {id_: b"".join(lines) for id_, lines in _whole(content) if id_ is not None}
    return {id_: text for id_, text in found.items() if text.strip()}


def ids(content: bytes) -> dict[str, int]:
    """Map the regions of a file to their first lines, from 0."""
    found: dict[str, int] = {}
    line = 0
    for id_, lines in _whole(content):
        if id_ is not None:
            found[id_] = line - 1
        line += len(lines)
    return found


def filled(content: bytes, of_user: Mapping[str, bytes]) -> tuple[bytes, list[str]]:
    """Insert user content in the regions of a new file; also return missing regions."""
    pieces = _whole(content)
    known = {id_ for id_, _ in pieces}
    text = b"".join(of_user.get(id_ or "", b"".join(lines)) for id_, lines in pieces)
    return text, [id_ for id_ in of_user if id_ not in known]


def _whole(content: bytes) -> list[tuple[str | None, list[bytes]]]:
    """Split like `_pieces`; with invalid marks, everything is outside."""
    try:
        return _pieces(content)
    except RegionError:
        return [(None, [content])]


def _pieces(content: bytes) -> list[tuple[str | None, list[bytes]]]:
    """Split into lines outside (None) and inside of regions; marks are outside.

    Raises RegionError.
    """
    if b"swarmc:" not in content:
        return [(None, [content])]
    pieces: list[tuple[str | None, list[bytes]]] = [(None, [])]
    begun: dict[str, int] = {}
    find = re.compile(_MARK).search
    for number, line in enumerate(content.splitlines(keepends=True)):
        mark = find(line)
        if mark is None:
            pieces[-1][1].append(line)
            continue
        kind, id_ = (word.decode() for word in mark.groups())
        inside = pieces[-1][0]
        if kind == "begin":
            if inside is not None:
                raise RegionError(number, f"region `{id_}` begins inside region `{inside}`")
            if id_ in begun:
                raise RegionError(number, f"region `{id_}` begins a second time")
            begun[id_] = number
            pieces[-1][1].append(line)
            pieces.append((id_, []))
        else:
            if inside != id_:
                raise RegionError(number, f"region `{id_}` ends where it has not begun")
            pieces.append((None, [line]))
    last = pieces[-1][0]
    if last is not None:
        raise RegionError(begun[last], f"region `{last}` has no end")
    return pieces
