"""The tokens of files as the protocol has them; those of what has not changed are kept.

Each token is five numbers, its place counted from the one before (LSP 3.17, "Semantic Tokens"). So
those of a declaration stay as they are wherever it is moved, but for the first two numbers.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from swarmdsl.analysis.resolve.scopes import Scopes
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import owners
from swarmdsl.ide.server.positions import units
from swarmdsl.ide.server.tokens import Token, of_head, of_owner
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import TopLevel


class _Stretch(NamedTuple):
    """Tokens that follow each other: where the first and the last begin, and their numbers.

    The place of the first is that of the token before.
    """

    first: int
    last: int
    numbers: list[int]


class Painter:
    """Finds the tokens of files, and remembers what was told."""

    def __init__(self) -> None:
        self._known: dict[TopLevel, _Stretch] = {}
        self._told: dict[str, tuple[str, Sequence[int]]] = {}
        self._count = 0

    def tokens(
        self, workspace: Workspace, file: File, encoding: str, within: Span | None = None
    ) -> list[int]:
        """The tokens of a file, or of the declarations that are in a part of it."""
        text = file.source.text
        found: list[int] = []
        last = 0
        for stretch in sorted(self._stretches(workspace, file, encoding, within)):
            if stretch.numbers and stretch.first >= last:
                found += _distance(text, last, stretch.first, encoding)
                found += stretch.numbers[2:]
                last = stretch.last
        return found

    def _stretches(
        self, workspace: Workspace, file: File, encoding: str, within: Span | None
    ) -> Iterator[_Stretch]:
        for tokens in of_head(file):
            yield _stretch(tokens, file.source.text, encoding)
        scope = Scopes(workspace.project)[file]
        known: dict[TopLevel, _Stretch] = {}
        for owner in owners(file):
            whole = owner.span.absolute
            if within is not None and (whole.end < within.start or within.end < whole.start):
                continue
            stretch = self._known.get(owner)
            if stretch is None:
                stretch = _stretch(of_owner(owner, scope), owner.span.source.text, encoding)
            known[owner] = stretch
            base = whole.start - owner.span.start
            yield _Stretch(stretch.first + base, stretch.last + base, stretch.numbers)
        if within is None:
            self._known = known

    def remember(self, name: str, data: Sequence[int]) -> str:
        """Keep what was told of a file; return by which name it is asked for."""
        self._count += 1
        self._told[name] = (str(self._count), data)
        return str(self._count)

    def remembered(self, name: str, result: object) -> Sequence[int] | None:
        """What was told of a file by some name, if that was the last time."""
        known, data = self._told.get(name, ("", None))
        return data if known == result else None

    def forget(self, name: str) -> None:
        """Forget what was told of a file."""
        self._told.pop(name, None)
        self._known.clear()


def changes(before: Sequence[int], now: Sequence[int]) -> list[tuple[int, int, Sequence[int]]]:
    """What to put in place of which numbers: where they begin, how many, and the new ones."""
    head = _same(before, now)
    if head == len(before) == len(now):
        return []
    tail = _same(before[head:][::-1], now[head:][::-1])
    return [(head, len(before) - tail - head, now[head : len(now) - tail])]


def _same(some: Sequence[int], others: Sequence[int]) -> int:
    """How many of the first are the same; halves are compared at once."""
    least, most = 0, min(len(some), len(others))
    while least < most:
        middle = (least + most + 1) // 2
        if some[least:middle] == others[least:middle]:
            least = middle
        else:
            most = middle - 1
    return least


def _stretch(tokens: Iterable[Token], text: str, encoding: str) -> _Stretch:
    ordered = sorted(tokens)
    first = last = ordered[0].start if ordered else 0
    numbers: list[int] = []
    for start, length, type_, modifiers in ordered:
        numbers += (*_distance(text, last, start, encoding), length, type_, modifiers)
        last = start
    return _Stretch(first, last, numbers)


def _distance(text: str, start: int, end: int, encoding: str) -> tuple[int, int]:
    """How many lines a place is behind another, and characters behind it or in its line."""
    lines = text.count("\n", start, end)
    if lines:
        start = text.rfind("\n", start, end) + 1
    return lines, units(text[start:end], encoding)
