"""Unified diffs, as of `diff -u` and `git diff`."""

from __future__ import annotations

import io
from collections.abc import Iterator

from swarmdsl.base.line_matching import line_matcher

_CONTEXT = 3


def unified_diff(before: bytes, after: bytes, name_before: str, name_after: str) -> str:
    """Return a unified diff; empty if nothing differs.

    Invalid UTF-8 is shown with replacement characters.
    """
    lines = _diff(_lines(before), _lines(after), name_before, name_after)
    return "".join(
        line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n" for line in lines
    )


def _diff(before: list[str], after: list[str], name_before: str, name_after: str) -> Iterator[str]:
    """Yield the lines of a diff, as `difflib.unified_diff` does."""
    groups = line_matcher(before, after).get_grouped_opcodes(_CONTEXT)
    for number, group in enumerate(groups):
        if not number:
            yield f"--- {name_before}\n"
            yield f"+++ {name_after}\n"
        (_, start, _, begin, _), (_, _, stop, _, end) = group[0], group[-1]
        yield f"@@ -{_range(start, stop)} +{_range(begin, end)} @@\n"
        for tag, low, high, first, last in group:
            if tag == "equal":
                yield from (f" {line}" for line in before[low:high])
                continue
            yield from (f"-{line}" for line in before[low:high])
            yield from (f"+{line}" for line in after[first:last])


def _range(start: int, stop: int) -> str:
    """Return a range of lines, from 1; an empty one is after a line."""
    length = stop - start
    if length == 1:
        return str(start + 1)
    return f"{start + 1 if length else start},{length}"


def _lines(content: bytes) -> list[str]:
    # Only `\n` ends a line here, as it does for the programs that read a diff.
    return io.StringIO(content.decode(errors="replace"), newline="\n").readlines()
