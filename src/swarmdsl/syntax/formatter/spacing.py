"""Spaces between the tokens of a line."""

from __future__ import annotations

from collections.abc import Sequence
from collections.abc import Set as AbstractSet

from swarmdsl.syntax.formatter.tokens import Kind, Token

_CLOSERS = frozenset({")", "]", ","})
_NOTHING_BEFORE = _CLOSERS | {"."}
_NOTHING_AFTER = frozenset({"(", "[", "."})


def join_tokens(tokens: Sequence[Token], tight: AbstractSet[int]) -> tuple[str, list[int]]:
    """Join tokens to a line; return the offset of each too."""
    pieces: list[str] = []
    starts: list[int] = []
    width = 0
    before: Token | None = None
    for token in tokens:
        if before is not None and _has_space_between(before, token, tight):
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


def _has_space_between(before: Token, token: Token, tight: AbstractSet[int]) -> bool:
    if token.is_comment:
        return before.text not in ("(", "[")
    if before.is_comment:
        return token.text not in _CLOSERS
    return not (
        token.start in tight or token.text in _NOTHING_BEFORE or before.text in _NOTHING_AFTER
    )
