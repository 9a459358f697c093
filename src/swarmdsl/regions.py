"""Regions of a generated file that are the user's: what stands in them is kept.

A region lies between two lines that say, in a comment of whatever language the file is in,
`swarmc:begin ID` and `swarmc:end ID`. The id is one of the model, so that a region is found
again wherever the rest of the file has moved to.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

Texts = Mapping[str, bytes]
"""What the user has written in each region."""

_MARK = re.compile(rb"swarmc:(begin|end) ([A-Za-z0-9_.]+)")


class RegionError(Exception):
    """The marks of a file are not as they were written; the text says what is wrong."""


def generated(content: bytes) -> bytes:
    """A file without what stands in its regions; all of it where the marks are wrong."""
    try:
        pieces = _pieces(content)
    except RegionError:
        return content
    return b"".join(b"".join(lines) for id_, lines in pieces if id_ is None)


def kept(content: bytes) -> dict[str, bytes]:
    """What the user has written in each region; blank ones are left out. Raises RegionError."""
    found = {id_: b"".join(lines) for id_, lines in _pieces(content) if id_ is not None}
    return {id_: text for id_, text in found.items() if text.strip()}


def ids(content: bytes) -> set[str]:
    """The regions of a file. Raises RegionError."""
    return {id_ for id_, _ in _pieces(content) if id_ is not None}


def filled(content: bytes, of_user: Mapping[str, bytes]) -> tuple[bytes, list[str]]:
    """A new file with what the user had written in its regions, and regions it does not have."""
    try:
        pieces = _pieces(content)
    except RegionError:
        pieces = [(None, [content])]
    known = {id_ for id_, _ in pieces}
    text = b"".join(of_user.get(id_ or "", b"".join(lines)) for id_, lines in pieces)
    return text, [id_ for id_ in of_user if id_ not in known]


def _pieces(content: bytes) -> list[tuple[str | None, list[bytes]]]:
    """The lines outside (None) and inside of regions, in turn; marks are outside."""
    pieces: list[tuple[str | None, list[bytes]]] = [(None, [])]
    if b"swarmc:" not in content:
        return [(None, [content])]
    seen: set[str] = set()
    for line in content.splitlines(keepends=True):
        mark = _MARK.search(line)
        if mark is None:
            pieces[-1][1].append(line)
            continue
        kind, id_ = (word.decode() for word in mark.groups())
        inside = pieces[-1][0]
        if kind == "begin":
            if inside is not None:
                raise RegionError(f"region `{id_}` begins inside region `{inside}`")
            if id_ in seen:
                raise RegionError(f"there are two regions `{id_}`")
            seen.add(id_)
            pieces[-1][1].append(line)
            pieces.append((id_, []))
        else:
            if inside != id_:
                raise RegionError(f"region `{id_}` ends where it has not begun")
            pieces.append((None, [line]))
    if pieces[-1][0] is not None:
        raise RegionError(f"region `{pieces[-1][0]}` has no end")
    return pieces
