"""What a build made, as a table for people."""

from __future__ import annotations

from collections import Counter
from typing import TextIO

from swarmdsl.output import Written
from swarmdsl.render import counted
from swarmdsl.render.printable import printable

_COLUMNS = ("written", "unchanged", "kept", "removed")


def render_written(written: Written, stream: TextIO) -> None:
    """Write the number of files by target, and what became of those no longer made."""
    counts = {
        column: Counter(path.partition("/")[0] for path in getattr(written, column))
        for column in _COLUMNS
    }
    columns = [column for column in _COLUMNS if counts[column] or column == "written"]
    targets = dict.fromkeys(target for counter in counts.values() for target in counter)
    rows = [[target, *(str(counts[each][target] or "-") for each in columns)] for target in targets]
    if rows:
        _render_table(["target", *columns], rows, stream)
    for path in written.left:
        place = printable(str(written.folder / path))
        stream.write(f"note: `{place}` is no longer generated; it was edited, so it stays\n")
    files = len(written.written) + len(written.unchanged) + len(written.kept)
    stream.write(f"{counted(files, 'file')} in {printable(str(written.folder))}\n")


def _render_table(head: list[str], rows: list[list[str]], stream: TextIO) -> None:
    """Write names on the left and numbers on the right of their columns."""
    width, *widths = (max(map(len, column)) for column in zip(head, *rows, strict=True))
    for row in (head, *rows):
        cells = (text.rjust(wide) for text, wide in zip(row[1:], widths, strict=True))
        stream.write("  ".join((row[0].ljust(width), *cells)) + "\n")
