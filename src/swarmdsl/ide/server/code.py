"""Words in a text that need not be one that can be parsed."""

from __future__ import annotations

import re
from collections.abc import Iterator


def found_in(
    text: str, pattern: re.Pattern[str], start: int = 0, end: int | None = None
) -> Iterator[tuple[int, str]]:
    """What a pattern finds, and where; a `/*` that it finds with all of its comment.

    One without an end is passed over: it is no comment. It takes as long as the text is, which a
    pattern of whole comments does not where many have no end.
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
