"""Paths in reports, relative to the current folder."""

from __future__ import annotations

import os
from pathlib import Path
from urllib.parse import quote


def relative_path(name: str) -> str:
    """Return the path relative to the current folder with `/`, or absolute if it is outside."""
    path = os.path.normpath(name)
    if os.path.isabs(path):  # noqa: PTH117 - the name of a source need not be a good path
        inside = os.path.relpath(path)
        path = path if os.pardir in Path(inside).parts else inside
    return path.replace(os.sep, "/")


def uri(name: str) -> str:
    """Return the path as URI reference, absolute only for an absolute path."""
    path = relative_path(name)
    if os.path.isabs(path):  # noqa: PTH117 - as above
        return Path(path).as_uri()
    # A name of a file need not be text.
    quoted = quote(os.fsencode(path))
    return quoted if ":" not in quoted.partition("/")[0] else f"./{quoted}"
