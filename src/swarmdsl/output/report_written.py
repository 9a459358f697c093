"""Print the result of a build as a table."""

from __future__ import annotations

from collections import Counter
from typing import TextIO

from swarmdsl.base.diagnostics.render import counted
from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.output import Action, Written
from swarmdsl.output.changes import NEW_TEXT


def render_written(written: Written, stream: TextIO) -> None:
    """Write the number of files per target, and the changes of the user's files."""
    counts = _counts(written)
    columns = [column for column in counts if counts[column] or column == "written"]
    targets = dict.fromkeys(target for counter in counts.values() for target in counter)
    rows = [[target, *(str(counts[each][target] or "-") for each in columns)] for target in targets]
    if rows:
        _render_table(["target", *columns], rows, stream)
    for change in written.changes:
        place = written.folder / change.path
        if change.action in (Action.MOVE, Action.RESTORE) and change.source is not None:
            said = f"`{written.folder / change.source}` is now `{place}`"
        elif change.action is Action.OVERWRITE:
            said = f"`{place}` was edited, and is overwritten"
        else:
            continue
        stream.write(f"note: {printable(said)}\n")
    there = ("written", "unchanged", "kept", "edited", "in conflict", "moved")
    files = sum(sum(counts[column].values()) for column in there)
    stream.write(f"{counted(files, 'file')} in {printable(str(written.folder))}\n")


def line(written: Written) -> str:
    """Return a summary such as "3 written, 41 unchanged"."""
    counts = {name: sum(counter.values()) for name, counter in _counts(written).items()}
    return ", ".join(f"{number} {name}" for name, number in counts.items() if number)


def _counts(written: Written) -> dict[str, Counter[str]]:
    """Count the files of each target by result."""
    return {
        "written": _by_target(written, *NEW_TEXT),
        "unchanged": Counter(map(_target, written.unchanged)),
        "kept": Counter(map(_target, written.kept)),
        "edited": Counter(map(_target, written.edited)),
        "in conflict": Counter(map(_target, written.conflicts)),
        "moved": _by_target(written, Action.MOVE, Action.RESTORE),
        "put aside": _by_target(written, Action.PARK),
        "removed": _by_target(written, Action.REMOVE),
    }


def _by_target(written: Written, *actions: Action) -> Counter[str]:
    return Counter(change.target for change in written.changes if change.action in actions)


def _target(path: str) -> str:
    return path.partition("/")[0]


def _render_table(head: list[str], rows: list[list[str]], stream: TextIO) -> None:
    """Write a table with names on the left and numbers on the right."""
    width, *widths = (max(map(len, column)) for column in zip(head, *rows, strict=True))
    for row in (head, *rows):
        cells = (text.rjust(wide) for text, wide in zip(row[1:], widths, strict=True))
        stream.write("  ".join((row[0].ljust(width), *cells)) + "\n")
