"""Differences of two texts, as `diff -u` and `git diff` show them."""

from __future__ import annotations

import difflib
import io


def unified_diff(before: bytes, after: bytes, name_before: str, name_after: str) -> str:
    """What changes, as a unified diff; empty where nothing does.

    What is not text is shown with marks of replacement.
    """
    lines = difflib.unified_diff(_lines(before), _lines(after), name_before, name_after)
    return "".join(
        line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n" for line in lines
    )


def _lines(content: bytes) -> list[str]:
    # Only `\n` ends a line here, as it does for the programs that read a diff.
    return io.StringIO(content.decode(errors="replace"), newline="\n").readlines()
