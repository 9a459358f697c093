"""Unified diffs, as of `diff -u` and `git diff`."""

from __future__ import annotations

import difflib
import io


def unified_diff(before: bytes, after: bytes, name_before: str, name_after: str) -> str:
    """Return a unified diff; empty if nothing differs.

    Invalid UTF-8 is shown with replacement characters.
    """
    lines = difflib.unified_diff(_lines(before), _lines(after), name_before, name_after)
    return "".join(
        line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n" for line in lines
    )


def _lines(content: bytes) -> list[str]:
    # Only `\n` ends a line here, as it does for the programs that read a diff.
    return io.StringIO(content.decode(errors="replace"), newline="\n").readlines()
