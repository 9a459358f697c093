"""A new layout as changes of lines: what stays is not touched, nor are marks and folds in it."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import SequenceMatcher

from swarmdsl.base.source import Source, Span

# Beyond that many lines that differ, comparing takes longer than an editor to take them.
_MOST = 4000


def line_changes(source: Source, text: str, within: Span) -> Iterator[tuple[Span, str]]:
    """The changes of lines that touch a part of a text, which make another one of it."""
    if text == source.text:
        return
    old, new = _lines(source.text), _lines(text)
    before = after = 0
    most = min(len(old), len(new))
    while before < most and old[before] == new[before]:
        before += 1
    while after < most - before and old[-1 - after] == new[-1 - after]:
        after += 1
    middle, made = old[before : len(old) - after], new[before : len(new) - after]
    blocks = [(0, len(middle), 0, len(made))]
    if len(middle) + len(made) <= _MOST:
        matcher = SequenceMatcher(None, middle, made, autojunk=False)
        blocks = [each[1:] for each in matcher.get_opcodes() if each[0] != "equal"]
    starts = [*source.line_starts, len(source.text)]
    for first, last, begin, end in blocks:
        span = Span(source, starts[before + first], starts[before + last])
        if span.start <= within.end and within.start <= span.end:
            yield span, "".join(made[begin:end])


def _lines(text: str) -> list[str]:
    """The lines with their ends; others than the protocol has are no ends."""
    lines = text.split("\n")
    return [*(f"{line}\n" for line in lines[:-1]), *filter(None, lines[-1:])]
