"""Lexical search in text that need not parse."""

from __future__ import annotations

import re
from collections.abc import Iterator


def find_tokens(
    text: str, pattern: re.Pattern[str], start: int = 0, end: int | None = None
) -> Iterator[tuple[int, str]]:
    """Yield matches of a pattern with their offsets; extend `/*` to the whole comment.

    An unterminated `/*` is skipped: it is no comment. The search is linear, whereas a pattern for
    whole comments is quadratic with many unterminated ones.
    """
    end = len(text) if end is None else end
    if text.find("/*", start, end) < 0:
        yield from ((each.start(), each[0]) for each in pattern.finditer(text, start, end))
        return
    last_close = text.rfind("*/", start, end)
    found = pattern.search(text, start, end)
    while found is not None:
        at, stop = found.span()
        if found[0] != "/*":
            yield at, found[0]
        elif stop <= last_close:
            stop = text.index("*/", stop) + 2
            yield at, text[at:stop]
        found = pattern.search(text, stop, end)
