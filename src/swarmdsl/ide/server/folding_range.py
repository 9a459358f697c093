"""What of a file can be folded: blocks, groups of imports, comments over several lines."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Literal

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source
from swarmdsl.ide.server.code import found_in

_TOKEN = re.compile(
    r'"[^"\\\n]*(?:\\[^\n][^"\\\n]*)*"?|//[^\n]*|/\*|[{}]|^[ \t]*import\b', re.MULTILINE
)


@dataclass(frozen=True)
class Fold:
    """Lines that are shown as their first one, counted from 0."""

    first: int
    last: int
    kind: Literal["comment", "imports", ""] = ""


def folds(source: Source) -> list[Fold]:
    """All that can be folded, in any text: braces that do not match are passed over."""
    tokens = list(found_in(source.text, _TOKEN))
    found = [*_blocks(source, tokens), *_groups(source, tokens)]
    return sorted((each for each in found if each.last > each.first), key=lambda each: each.first)


def _line(source: Source, offset: int) -> int:
    return source.line_column(offset)[0] - 1


def _blocks(source: Source, tokens: Iterable[tuple[int, str]]) -> Iterator[Fold]:
    opened: list[int] = []
    for at, token in tokens:
        if token == "{":
            opened.append(_line(source, at))
        elif token == "}" and opened:
            # The line of the closing brace stays in sight.
            yield Fold(opened.pop(), _line(source, at) - 1)
        elif token.startswith("/*"):
            yield Fold(_line(source, at), _line(source, at + len(token) - 1), "comment")


def _groups(source: Source, tokens: Iterable[tuple[int, str]]) -> Iterator[Fold]:
    """Comments and imports on lines that follow each other."""
    before = Fold(0, -1)
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
            before = Fold(before.first, line, kind)
            continue
        yield before
        before = Fold(line, line, kind)
    yield before
