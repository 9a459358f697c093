"""Tokens to the text of a line: which of them stand together."""

from __future__ import annotations

from collections.abc import Sequence
from collections.abc import Set as AbstractSet

from swarmdsl.syntax.formatter.tokens import Kind, Token

_CLOSERS = frozenset({")", "]", ","})
_NOTHING_BEFORE = _CLOSERS | {"."}
_NOTHING_AFTER = frozenset({"(", "[", "."})


def joined(tokens: Sequence[Token], tight: AbstractSet[int]) -> tuple[str, list[int]]:
    """The tokens as one line, and where in it each of them begins."""
    pieces: list[str] = []
    starts: list[int] = []
    width = 0
    before: Token | None = None
    for token in tokens:
        if before is not None and _spaced(before, token, tight):
            pieces.append(" ")
            width += 1
        starts.append(width)
        text = token.text
        if token.kind is Kind.BLOCK_COMMENT and "\n" in text:
            text = "\n".join(line.rstrip() for line in text.split("\n"))
        pieces.append(text)
        width += len(text)
        before = token
    return "".join(pieces), starts


def _spaced(before: Token, token: Token, tight: AbstractSet[int]) -> bool:
    if token.is_comment:
        return before.text not in ("(", "[")
    if before.is_comment:
        return token.text not in _CLOSERS
    return not (
        token.start in tight or token.text in _NOTHING_BEFORE or before.text in _NOTHING_AFTER
    )
