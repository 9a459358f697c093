"""Wrap the tokens of an item to lines, at the best places to break."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.syntax.formatter.lines import INDENT, WIDTH, Line
from swarmdsl.syntax.formatter.marks import Marks
from swarmdsl.syntax.formatter.spacing import join_tokens
from swarmdsl.syntax.formatter.tokens import Kind, Token

# How early a place is chosen for a break: before a clause, then after the commas of the
# outermost list, before `and` and `or` there, and so on inwards (two levels a bracket).
_CLAUSE, _LIST, _OPERATION = range(3)
_FORCED = 1000  # by a comment


def wrap(tokens: list[Token], indent: int, marks: Marks) -> list[Line]:
    """Wrap the tokens of an item; continuation lines are indented further."""
    text, _ = join_tokens(tokens, marks.tight)
    commented = any(token.kind is Kind.LINE_COMMENT for token in tokens)
    if not commented and indent + len(text) <= WIDTH:
        return [Line(indent, text)]
    return list(_Wrapper(tokens, marks).lines(0, len(tokens), indent))


class _Wrapper:
    def __init__(self, tokens: list[Token], marks: Marks) -> None:
        self._tokens = tokens
        self._tight = marks.tight
        self._levels: dict[int, int] = {}
        self._forced: set[int] = set()
        self._find_breaks(marks)

    def _find_breaks(self, marks: Marks) -> None:
        """Find the tokens before which a line may break, and must break."""
        tokens = self._tokens
        depth = 0
        for index, token in enumerate(tokens):
            if token.start in marks.clauses:
                self._levels[index] = _CLAUSE
            elif token.text in ("and", "or") and tokens[index - 1].text != ".":
                self._levels[index] = 2 * depth + _OPERATION
            elif token.text in ("(", "["):
                depth += 1
                is_list = token.start in marks.tight or tokens[index - 1].text == "gives"
                if token.text == "(" and is_list:
                    self._levels[self._after_comments(index + 1)] = 2 * depth + _LIST
            elif token.text in (")", "]"):
                depth -= 1
            elif token.text == ",":
                self._levels[self._after_comments(index + 1)] = 2 * depth + _LIST
            elif token.kind is Kind.LINE_COMMENT:
                if token.newlines and index:
                    self._forced.add(index)
                self._forced.add(index + 1)
        for index in self._forced:
            self._levels.setdefault(index, _FORCED)

    def _after_comments(self, index: int) -> int:
        """Return the index after the trailing comments at `index`, or `index` if there are none."""
        tokens, at = self._tokens, index
        while at < len(tokens) and tokens[at].is_comment and not tokens[at].newlines:
            at += 1
        return at if at < len(tokens) and tokens[at].newlines else index

    def lines(self, first: int, end: int, indent: int) -> Iterator[Line]:
        """Yield the lines of a range of tokens."""
        tokens = self._tokens
        while first < end and tokens[first].kind is Kind.LINE_COMMENT:
            yield Line(indent, tokens[first].text, is_comment=True)
            first += 1
        if first == end:
            return
        last = end
        if tokens[end - 1].kind is Kind.LINE_COMMENT and not tokens[end - 1].newlines:
            last -= 1
        level = self._level(first, last, indent)
        if level is None:
            text, _ = join_tokens(tokens[first:last], self._tight)
            trailing = "".join(f"  {comment.text}" for comment in tokens[last:end])
            yield Line(indent, text, trailing)
            return
        further = indent + (INDENT if level in (_CLAUSE, _LIST, _FORCED) else 2 * INDENT)
        starts = [at for at in range(first + 1, last) if self._levels.get(at) == level]
        for start, stop in zip([first, *starts], [*starts, end], strict=True):
            yield from self.lines(start, stop, indent if start == first else further)

    def _level(self, first: int, last: int, indent: int) -> int | None:
        """Return the level at which to break a range; None to keep it on one line."""
        inside = {at: self._levels[at] for at in range(first + 1, last) if at in self._levels}
        code = [token for token in self._tokens[first:last] if token.kind is not Kind.LINE_COMMENT]
        text, _ = join_tokens(code, self._tight)
        if indent + len(text) > WIDTH:
            return min(inside.values(), default=None)
        forced = [inside[at] for at in inside if at in self._forced]
        if forced and _CLAUSE in inside.values():
            return _CLAUSE
        return min(forced, default=None)
