"""What of a file can be folded: blocks, groups of imports, comments over several lines."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Literal

from swarmdsl.dataclass import dataclass
from swarmdsl.source import Source

_TOKEN = re.compile(
    r'"(?:[^"\\\n]|\\[^\n])*"|//[^\n]*|/\*(?:[^*]|\*(?!/))*\*/|[{}]|^[ \t]*import\b', re.MULTILINE
)


@dataclass(frozen=True)
class Fold:
    """Lines that are shown as their first one, counted from 0."""

    first: int
    last: int
    kind: Literal["comment", "imports", ""] = ""


def folds(source: Source) -> list[Fold]:
    """All that can be folded, in any text: braces that do not match are passed over."""
    found = [*_blocks(source), *_groups(source)]
    return sorted((each for each in found if each.last > each.first), key=lambda each: each.first)


def _line(source: Source, offset: int) -> int:
    return source.line_column(offset)[0] - 1


def _blocks(source: Source) -> Iterator[Fold]:
    opened: list[int] = []
    for token in _TOKEN.finditer(source.text):
        if token[0] == "{":
            opened.append(_line(source, token.start()))
        elif token[0] == "}" and opened:
            # The line of the closing brace stays in sight.
            yield Fold(opened.pop(), _line(source, token.start()) - 1)
        elif token[0].startswith("/*"):
            first, last = token.start(), token.end() - 1
            yield Fold(_line(source, first), _line(source, last), "comment")


def _groups(source: Source) -> Iterator[Fold]:
    """Comments and imports on lines that follow each other."""
    before = Fold(0, -1)
    for token in _TOKEN.finditer(source.text):
        word = token[0].lstrip()
        kind: Literal["comment", "imports", ""] = ""
        start = token.start() + len(token[0]) - len(word)
        begins = not source.text[source.text.rfind("\n", 0, start) + 1 : start].strip()
        if word.startswith("//") and begins:
            kind = "comment"
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
