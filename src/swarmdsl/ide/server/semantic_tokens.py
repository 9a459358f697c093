"""Encoded semantic tokens of files, cached by declaration.

A token is five numbers; its position is relative to the previous token (LSP 3.17, "Semantic
Tokens"). So the encoding of a declaration stays valid when it moves, except for the first two
numbers.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from swarmdsl.analysis.resolve.scopes import Scopes
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import owners
from swarmdsl.ide.server.positions import units
from swarmdsl.ide.server.tokens import Token, declaration_tokens, head_tokens
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import TopLevel


class _TokenRun(NamedTuple):
    """Encoded tokens in a row, with the offsets of the first and the last one.

    The position of the first token is relative to that of the token before the run.
    """

    first: int
    last: int
    numbers: list[int]


class SemanticTokenCache:
    """Encode the tokens of files and remember the results sent."""

    def __init__(self) -> None:
        self._known: dict[TopLevel, _TokenRun] = {}
        self._sent: dict[str, tuple[str, Sequence[int]]] = {}
        self._count = 0

    def tokens(
        self, workspace: Workspace, file: File, encoding: str, within: Span | None = None
    ) -> list[int]:
        """Return the encoded tokens of a file, or of its declarations that overlap `within`."""
        text = file.source.text
        found: list[int] = []
        last = 0
        for run in sorted(self._token_runs(workspace, file, encoding, within)):
            if run.numbers and run.first >= last:
                found += _distance(text, last, run.first, encoding)
                found += run.numbers[2:]
                last = run.last
        return found

    def _token_runs(
        self, workspace: Workspace, file: File, encoding: str, within: Span | None
    ) -> Iterator[_TokenRun]:
        for tokens in head_tokens(file):
            yield _token_run(tokens, file.source.text, encoding)
        scope = Scopes(workspace.project)[file]
        known: dict[TopLevel, _TokenRun] = {}
        for owner in owners(file):
            whole = owner.span.absolute
            if within is not None and (whole.end < within.start or within.end < whole.start):
                continue
            run = self._known.get(owner)
            if run is None:
                run = _token_run(declaration_tokens(owner, scope), owner.span.source.text, encoding)
            known[owner] = run
            base = whole.start - owner.span.start
            yield _TokenRun(run.first + base, run.last + base, run.numbers)
        if within is None:
            self._known = known

    def remember(self, name: str, data: Sequence[int]) -> str:
        """Store a result sent for a file; return its result id."""
        self._count += 1
        self._sent[name] = (str(self._count), data)
        return str(self._count)

    def remembered(self, name: str, result: object) -> Sequence[int] | None:
        """Return the result of a file with this id, if it was the last one."""
        known, data = self._sent.get(name, ("", None))
        return data if known == result else None

    def forget(self, name: str) -> None:
        """Forget the results of a file."""
        self._sent.pop(name, None)
        self._known.clear()


def changes(before: Sequence[int], now: Sequence[int]) -> list[tuple[int, int, Sequence[int]]]:
    """Return edits as start, number of deleted numbers, and inserted numbers."""
    head = _same(before, now)
    if head == len(before) == len(now):
        return []
    tail = _same(before[head:][::-1], now[head:][::-1])
    return [(head, len(before) - tail - head, now[head : len(now) - tail])]


def _same(some: Sequence[int], others: Sequence[int]) -> int:
    """Return the length of the common prefix, by bisection."""
    least, most = 0, min(len(some), len(others))
    while least < most:
        middle = (least + most + 1) // 2
        if some[least:middle] == others[least:middle]:
            least = middle
        else:
            most = middle - 1
    return least


def _token_run(tokens: Iterable[Token], text: str, encoding: str) -> _TokenRun:
    ordered = sorted(tokens)
    first = last = ordered[0].start if ordered else 0
    numbers: list[int] = []
    for start, length, type_, modifiers in ordered:
        numbers += (*_distance(text, last, start, encoding), length, type_, modifiers)
        last = start
    return _TokenRun(first, last, numbers)


def _distance(text: str, start: int, end: int, encoding: str) -> tuple[int, int]:
    """Return the lines between two offsets, and the characters in the last line."""
    lines = text.count("\n", start, end)
    if lines:
        start = text.rfind("\n", start, end) + 1
    return lines, units(text[start:end], encoding)
