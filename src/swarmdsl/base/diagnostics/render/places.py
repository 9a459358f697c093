"""Paths as other tools expect them: from the folder where swarmc was started."""

from __future__ import annotations

import os
from pathlib import Path
from urllib.parse import quote


def relative_path(name: str) -> str:
    """The path from the current folder with `/`, or the whole one where it leads out of it."""
    path = os.path.normpath(name)
    if os.path.isabs(path):  # noqa: PTH117 - the name of a source need not be a good path
        inside = os.path.relpath(path)
        path = path if os.pardir in Path(inside).parts else inside
    return path.replace(os.sep, "/")


def uri(name: str) -> str:
    """The same as a URI reference, absolute only for an absolute path."""
    path = relative_path(name)
    if os.path.isabs(path):  # noqa: PTH117 - as above
        return Path(path).as_uri()
    # A name of a file need not be text.
    quoted = quote(os.fsencode(path))
    return quoted if ":" not in quoted.partition("/")[0] else f"./{quoted}"
