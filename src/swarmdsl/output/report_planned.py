"""Print planned changes, one line per file or as a unified diff."""

from __future__ import annotations

import json
import os
from typing import TextIO

from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.base.unified_diff import unified_diff
from swarmdsl.output import Change, Written

_NOTHING = "/dev/null"
_STYLES = {"+": "green", "-": "red", "@": "cyan"}


def render_plan(written: Written, format_: str, stream: TextIO) -> None:
    """Write one line per changed file; format `json` writes an object per line."""
    for change in written.changes:
        place, source = _places(written, change)
        if format_ == "json":
            line = json.dumps({"action": change.action.value, "file": place, "from": source})
        else:
            came = f" from {source}" if source is not None else ""
            line = printable(f"{change.action.value:<9} {place}{came}")
        stream.write(f"{line}\n")


def render_diff(written: Written, stream: TextIO) -> None:
    """Write a diff for `git apply` and `patch`, coloured on a terminal."""
    for change in written.changes:
        place, source = _places(written, change)
        before, after = change.before or b"", change.after or b""
        name_before = _NOTHING if change.before is None else source or place
        name_after = _NOTHING if change.after is None else place
        text = unified_diff(before, after, name_before, name_after)
        if name_before != name_after and not text:
            # The diff of an empty or only moved file has nothing but its header.
            text = f"--- {name_before}\n+++ {name_after}\n"
        _write(text, stream)


def _places(written: Written, change: Change) -> tuple[str, str | None]:
    source = None if change.source is None else (written.folder / change.source).as_posix()
    return (written.folder / change.path).as_posix(), source


def _write(text: str, stream: TextIO) -> None:
    if not (stream.isatty() or os.environ.get("FORCE_COLOR")):
        stream.write(text)
        return
    # Imported here because it is slow, and only colours need it.
    from rich.console import Console
    from rich.text import Text

    console = Console(file=stream, highlight=False, soft_wrap=True)
    for line in text.splitlines():
        bold = line.startswith(("---", "+++"))
        console.print(Text(printable(line), "bold" if bold else _STYLES.get(line[:1], "")))
