"""Folding ranges: blocks, groups of imports, multi-line comments."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Literal

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source
from swarmdsl.ide.server.code import find_tokens

_TOKEN = re.compile(
    r'"[^"\\\n]*(?:\\[^\n][^"\\\n]*)*"?|//[^\n]*|/\*|[{}]|^[ \t]*import\b', re.MULTILINE
)


@dataclass(frozen=True)
class FoldingRange:
    """Range of lines, counted from 0, that folds to its first line."""

    first: int
    last: int
    kind: Literal["comment", "imports", ""] = ""


def folding_ranges(source: Source) -> list[FoldingRange]:
    """Return the folding ranges of a source, which may have syntax errors."""
    tokens = list(find_tokens(source.text, _TOKEN))
    found = [*_blocks(source, tokens), *_groups(source, tokens)]
    return sorted((each for each in found if each.last > each.first), key=lambda each: each.first)


def _line(source: Source, offset: int) -> int:
    return source.line_column(offset)[0] - 1


def _blocks(source: Source, tokens: Iterable[tuple[int, str]]) -> Iterator[FoldingRange]:
    opened: list[int] = []
    for at, token in tokens:
        if token == "{":
            opened.append(_line(source, at))
        elif token == "}" and opened:
            # The line of the closing brace stays visible.
            yield FoldingRange(opened.pop(), _line(source, at) - 1)
        elif token.startswith("/*"):
            yield FoldingRange(_line(source, at), _line(source, at + len(token) - 1), "comment")


def _groups(source: Source, tokens: Iterable[tuple[int, str]]) -> Iterator[FoldingRange]:
    """Yield groups of comments and of imports on consecutive lines."""
    before = FoldingRange(0, -1)
    for at, token in tokens:
        word = token.lstrip()
        kind: Literal["comment", "imports", ""] = ""
        start = at + len(token) - len(word)
        if word.startswith("//"):
            row = source.text[source.text.rfind("\n", 0, start) + 1 : start]
            kind = "" if row.strip() else "comment"
        elif word == "import":
            kind = "imports"
        if not kind:
            continue
        line = _line(source, start)
        if kind == before.kind and line <= before.last + (2 if kind == "imports" else 1):
            before = FoldingRange(before.first, line, kind)
            continue
        yield before
        before = FoldingRange(line, line, kind)
    yield before
