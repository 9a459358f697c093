"""Format files on disk: compute the changes and write them."""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Iterable, Sequence
from pathlib import Path

from swarmdsl.base.atomic_write import Staging
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.rewriting import Layout
from swarmdsl.project.loader import expanded
from swarmdsl.project.read_source import decoded, read_bytes
from swarmdsl.syntax.formatter import format_source

STDIN = "<stdin>"
_LINE_END = re.compile(rb"\r\n|\n|\r")


def layout_of(
    name: str, content: bytes, report: Diagnostics, *, migrate: bool = False
) -> Layout | None:
    """Compute the layout of a file; None if it has errors, which are reported.

    All line ends become like the first one; a byte order mark is removed.
    """
    source = decoded(Path(name), content, None, report)
    text = format_source(source, report, migrate=migrate) if source is not None else None
    if text is None:
        return None
    after = text.encode()
    first = _LINE_END.search(content)
    if first is not None and first[0] == b"\r\n":
        after = after.replace(b"\n", b"\r\n")
    return Layout(name, content, after)


def layouts_of(
    paths: Iterable[Path], report: Diagnostics, *, migrate: bool = False
) -> tuple[list[Layout], int]:
    """Compute the layouts of files and folders, and count the files with errors."""
    layouts, wrong = [], 0
    known = set()
    for path in expanded(paths, report):
        identity = os.path.realpath(path)
        if identity in known:
            continue
        known.add(identity)
        content = read_bytes(path, None, report)
        layout = None
        if content is not None:
            layout = layout_of(str(path), content, report, migrate=migrate)
        if layout is None:
            wrong += 1
        else:
            layouts.append(layout)
    return layouts, wrong


def write(layouts: Sequence[Layout], report: Diagnostics) -> bool:
    """Replace all files or none; return False if that fails."""
    try:
        with Staging() as staging:
            for layout in layouts:
                # Replace the target of a symbolic link, not the link.
                place = Path(os.path.realpath(layout.name))
                staging.add(place, layout.after, mode=stat.S_IMODE(place.stat().st_mode))
            for _ in staging.move_in_place():
                pass
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        report.report("cannot-write", path=error.filename or "", reason=reason)
        return False
    return True
