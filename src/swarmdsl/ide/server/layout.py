"""Formatting as line edits; unchanged lines keep their breakpoints and folds."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.line_matching import line_matcher
from swarmdsl.base.source import Source, Span

# With more changed lines, a diff takes longer than replacing them all.
_MAX_CHANGED_LINES = 4000


def line_changes(source: Source, text: str, within: Span) -> Iterator[tuple[Span, str]]:
    """Yield line edits that overlap `within` and turn the source into `text`."""
    if text == source.text:
        return
    old, new = _lines(source.text), _lines(text)
    before = after = 0
    most = min(len(old), len(new))
    while before < most and old[before] == new[before]:
        before += 1
    while after < most - before and old[-1 - after] == new[-1 - after]:
        after += 1
    middle, replacement = old[before : len(old) - after], new[before : len(new) - after]
    blocks = [(0, len(middle), 0, len(replacement))]
    if len(middle) + len(replacement) <= _MAX_CHANGED_LINES:
        matcher = line_matcher(middle, replacement, autojunk=False)
        blocks = [each[1:] for each in matcher.get_opcodes() if each[0] != "equal"]
    starts = [*source.line_starts, len(source.text)]
    for first, last, begin, end in blocks:
        span = Span(source, starts[before + first], starts[before + last])
        if span.start <= within.end and within.start <= span.end:
            yield span, "".join(replacement[begin:end])


def _lines(text: str) -> list[str]:
    """Split into lines with their ends; only a line feed is a line end here."""
    lines = text.split("\n")
    return [*(f"{line}\n" for line in lines[:-1]), *filter(None, lines[-1:])]
