"""What a build made, as a table for people."""

from __future__ import annotations

from collections import Counter
from typing import TextIO

from rich.console import Console
from rich.table import Table
from rich.text import Text

from swarmdsl.output import Written
from swarmdsl.render import counted
from swarmdsl.render.printable import printable

_COLUMNS = ("written", "unchanged", "kept", "removed")


def render_written(written: Written, stream: TextIO) -> None:
    """Write the number of files by target, and what became of those no longer made."""
    console = Console(file=stream, highlight=False, soft_wrap=True)
    counts = {
        column: Counter(path.partition("/")[0] for path in getattr(written, column))
        for column in _COLUMNS
    }
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("target", no_wrap=True)
    columns = [column for column in _COLUMNS if counts[column] or column == "written"]
    for column in columns:
        table.add_column(column, justify="right", no_wrap=True)
    targets = dict.fromkeys(target for counter in counts.values() for target in counter)
    for target in targets:
        table.add_row(target, *(str(counts[column][target] or "-") for column in columns))
    if targets:
        console.print(table)
    for path in written.left:
        place = printable(str(written.folder / path))
        console.print(Text(f"note: `{place}` is no longer generated; it was edited, so it stays"))
    files = len(written.written) + len(written.unchanged) + len(written.kept)
    console.print(Text(f"{counted(files, 'file')} in {printable(str(written.folder))}"))
