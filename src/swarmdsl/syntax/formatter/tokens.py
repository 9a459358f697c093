"""Tokens with comments: each character except white space is in one token."""

from __future__ import annotations

import re
from bisect import bisect_left
from enum import Enum, auto

from swarmdsl.base.records import dataclass


class Kind(Enum):
    """Kind of a token."""

    WORD = auto()
    NUMBER = auto()
    STRING = auto()
    SYMBOL = auto()
    LINE_COMMENT = auto()
    BLOCK_COMMENT = auto()


@dataclass(frozen=True, slots=True)
class Token:
    """Token; `newlines` counts the line breaks before it."""

    kind: Kind
    text: str
    start: int
    newlines: int

    @property
    def is_comment(self) -> bool:
        """Return True for a comment."""
        return self.kind in _COMMENTS


_COMMENTS = (Kind.LINE_COMMENT, Kind.BLOCK_COMMENT)

_TOKEN = re.compile(
    r"(?P<WORD>[A-Za-z_][A-Za-z0-9_]*)"
    r"|(?P<NUMBER>\d+(?:\.\d+)?(?:[eE][+-]?\d+)?)"
    r'|(?P<STRING>"(?:[^"\\\n]|\\[^\n])*")'
    r"|(?P<LINE_COMMENT>//[^\n]*)"
    r"|(?P<BLOCK_COMMENT>/\*(?:[^*]|\*(?!/))*\*/)"
    r"|(?P<SYMBOL>->|=>|==|!=|<=|>=|\.\.|[^\s])"
)


def tokenize(text: str) -> list[Token]:
    """Tokenize a text; an unknown character is a symbol."""
    tokens = []
    end = 0
    for found in _TOKEN.finditer(text):
        start = found.start()
        assert found.lastgroup is not None
        kind = Kind[found.lastgroup]
        written = found[0].rstrip() if kind is Kind.LINE_COMMENT else found[0]
        tokens.append(Token(kind, written, start, text.count("\n", end, start)))
        end = found.end()
    return tokens


def content_of(tokens: list[Token]) -> list[tuple[str, bool]]:
    """Return what formatting must keep: the tokens, and which comments document something.

    Lines of block comments may be re-indented; `///` documents only at the start of a line.
    Semicolons, and commas outside of parentheses, are left out: they may separate items.
    """
    content = []
    depth = 0
    for index, token in enumerate(tokens):
        depth += (token.text == "(") - (token.text == ")")
        if token.text == ";" or (token.text == "," and depth == 0):
            continue
        text = token.text
        if token.kind is Kind.BLOCK_COMMENT:
            text = "\n".join(line.strip() for line in text.split("\n"))
        is_doc = token.kind is Kind.LINE_COMMENT and text.startswith("///")
        content.append((text, is_doc and (index == 0 or token.newlines > 0)))
    return content


class Tokens:
    """Tokens of a text by offset, with or without comments."""

    def __init__(self, text: str) -> None:
        self.all = tokenize(text)
        self._code = [token for token in self.all if not token.is_comment]
        self._starts = [token.start for token in self._code]

    def code(self, start: int, count: int = 1) -> list[Token]:
        """Return the first `count` tokens from an offset on, without comments."""
        at = bisect_left(self._starts, start)
        return self._code[at : at + count]

    def before(self, start: int) -> Token:
        """Return the last token before an offset that is no comment."""
        return self._code[bisect_left(self._starts, start) - 1]
