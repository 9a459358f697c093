"""Separators of items: none at the ends of lines, `,` between values on one line."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from swarmdsl.syntax.formatter.marks import Marks
from swarmdsl.syntax.formatter.tokens import Kind, Token

_COMMA = Token(Kind.SYMBOL, ",", -1, 0)


def without_separators(tokens: Sequence[Token], marks: Marks) -> list[Token]:
    """Leave out the separators of items, and mark the tokens after them; commas in lists stay."""
    kept: list[Token] = []
    ends = True  # True if an item begins or a body ends with the next token that is no comment
    for token in reversed(tokens):
        if token.text == ";" or (token.text == "," and ends):
            if kept:
                marks.separated.add(kept[-1].start)
            continue
        if not token.is_comment:
            ends = token.text == "}" or token.start in marks.items
        kept.append(token)
    kept.reverse()
    return kept


def with_commas(body: Iterable[Token], marks: Marks) -> Iterator[Token]:
    """Yield the tokens of a body on one line, with commas between the items of each body in it."""
    ends = False  # True after an item of the same body, until the comma
    for token in body:
        if ends and (token.start in marks.items or token.start in marks.separated):
            if token.text != "}":
                yield _COMMA
            ends = False
        if not token.is_comment:
            ends = token.text != "{"
        yield token
