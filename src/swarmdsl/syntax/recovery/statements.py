"""Find statements in a text with syntax errors.

A statement begins on its own line, continues on lines that are indented further or begin with a
token that cannot begin a statement, and ends with its block, if it has one. Some keywords begin
a statement anywhere.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from swarmdsl.base.records import dataclass
from swarmdsl.syntax.parser.keywords import (
    BEFORE_NAMES,
    CLAUSES,
    MODIFIERS,
    STATEMENTS,
    TOP_LEVEL,
)

_TOKEN = re.compile(
    r'(?P<comment>//[^\n]*|/\*(?s:.*?)(?:\*/|\Z))|(?P<text>"[^"\\\n]*(?:\\[^\n][^"\\\n]*)*"?)'
    r"|[^\W\d]\w*|\d[\w.]*|->|=>|[=!<>]=|&&|\|\||\.\.|\S"
)


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


# A keyword does not begin a statement after its modifier. `on after 5 s`, a common error, is one
# statement, and `P only after Q` and `lost after 5 s` are parts of one.
_NOT_AFTER: dict[str, set[str]] = {"after": {"on", "only", "lost"}}
for _modifier, _targets in MODIFIERS.items():
    for _target in _targets:
        _NOT_AFTER.setdefault(_target, set()).add(_modifier)
_CONTINUATIONS = CLAUSES.keys() | _words(
    "-> => / , ) ] = : . .. + * % == != < > <= >= ( && || and or {"
)
# After these a keyword is a name or a part of the same statement.
_LEADS = BEFORE_NAMES | (MODIFIERS.keys() - STATEMENTS) | _words("< -> => = : . , ( [ - /")
_NEXT = re.compile(r"[ \t]*(\S?)")


@dataclass(frozen=True, slots=True)
class Statement:
    """Range of a statement; `header` is the offset of the `{` of its block, or else its end.

    `inside` is the statement whose block contains it.
    """

    start: int
    header: int
    end: int
    inside: _OpenStatement | None = None

    @property
    def around(self) -> tuple[tuple[int, int], ...]:
        """Headers of the blocks around it, outermost first."""
        found = []
        block = self.inside
        while block is not None:
            found.append((block.start, block.brace + 1))
            block = block.inside
        return tuple(reversed(found))


@dataclass(slots=True)
class _OpenStatement:
    start: int
    column: int
    brace: int = -1
    brackets: int = 0
    word: str = ""
    inside: _OpenStatement | None = None


def statement_at(text: str, at: int) -> Statement:
    """Return the innermost statement around an offset, or the last one before it."""
    last: Statement | None = None
    for one in _statements(text):
        if one.start <= at < max(one.end, one.start + 1):
            return one
        if last is None or one.start <= at:
            last = one
        elif not one.around or one.around[0][0] > at:
            break  # all others begin after it
    return last or Statement(0, len(text), len(text))


def statements_at(text: str, places: Iterable[int]) -> Iterator[Statement]:
    """Yield `statement_at` for each of many offsets, in one pass."""
    ordered = sorted(_statements(text), key=lambda one: one.start)
    around: list[Statement] = []
    begun = 0
    for at in sorted(places) if ordered else ():
        while begun < len(ordered) and ordered[begun].start <= at:
            around.append(ordered[begun])
            begun += 1
        while around and max(around[-1].end, around[-1].start + 1) <= at:
            around.pop()
        yield around[-1] if around else ordered[max(begun - 1, 0)]


def _statements(text: str) -> Iterator[Statement]:
    """Yield all statements, inner ones first."""
    opened: list[_OpenStatement] = []  # statements whose block is open
    current: _OpenStatement | None = None
    last = ""
    last_end = line_end = 0
    column = 0

    def finished(current: _OpenStatement, end: int) -> Statement:
        header = current.brace if current.brace >= 0 else end
        return Statement(current.start, header, end, opened[-1] if opened else None)

    for token in _TOKEN.finditer(text):
        if token.lastgroup == "comment":
            continue
        at, word = token.start(), token[0]
        first = at >= line_end
        if first:
            line = text.rfind("\n", 0, at) + 1
            column = len(text[line:at].expandtabs(4))
            line_end = text.find("\n", at)
            line_end = len(text) if line_end < 0 else line_end
        if word == "{":
            if current is None:
                current = _OpenStatement(at, column)
            current.brace = at
            current.inside = opened[-1] if opened else None
            opened.append(current)
            current = None
        elif word == "}":
            if current is not None:
                yield finished(current, last_end)
            if opened:
                yield finished(opened.pop(), at + 1)
            current = None
        else:
            if current is not None and _begins(text, token, word, last, first, column, current):
                yield finished(current, last_end)
                current = None
            if current is None:
                current = _OpenStatement(at, column, word=word)
            current.brackets += {"(": 1, "[": 1, ")": -1, "]": -1}.get(word, 0)
        last, last_end = word, token.end()
    if current is not None:
        yield finished(current, last_end)
    end = len(text.rstrip())
    while opened:
        yield finished(opened.pop(), end)


def _begins(
    text: str,
    token: re.Match[str],
    word: str,
    last: str,
    first: bool,
    column: int,
    current: _OpenStatement,
) -> bool:
    """Return True if a token begins a statement although another one is open."""
    if word in STATEMENTS and last not in _NOT_AFTER.get(word, ()):
        found = _NEXT.match(text, token.end())
        follows = found[1] if found else ""
        if not (word == "on" and (follows == '"' or current.word in CLAUSES["on"]) and not first):
            return first or (follows not in ("", ":", "=", ".", ",", ")") and last not in _LEADS)
    if not first:
        declares = word in TOP_LEVEL and current.word in TOP_LEVEL and not current.brackets
        return declares and column == 0 and last not in _LEADS
    return current.brackets <= 0 and word not in _CONTINUATIONS and column <= current.column
