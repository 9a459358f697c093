"""Tokens to items: what stands on lines of its own, with the comments around it."""

from __future__ import annotations

from swarmdsl.base.records import dataclass, field
from swarmdsl.syntax.ast import Node
from swarmdsl.syntax.formatter.marks import Marks
from swarmdsl.syntax.formatter.tokens import Token


@dataclass(slots=True)
class Item:
    """A declaration, a statement or the like.

    `above` are the comments on lines of their own before it, a list a line; `head` are its
    tokens, without those of its body; `behind` are the comments on its last line. `node` is
    None for the sections of services and actions, and for what follows the last item.
    """

    above: list[list[Token]]
    node: Node | None = None
    head: list[Token] = field(default_factory=list)
    body: Body | None = None
    behind: list[Token] = field(default_factory=list)


@dataclass(slots=True)
class Body:
    """What stands between braces, or in the file.

    `tokens` are all of it with its braces, `behind` the comments behind the opening brace,
    `below` those on lines of their own before the closing one.
    """

    tokens: list[Token] = field(default_factory=list)
    behind: list[Token] = field(default_factory=list)
    items: list[Item] = field(default_factory=list)
    below: list[list[Token]] = field(default_factory=list)

    @property
    def on_one_line(self) -> bool:
        """Whether it was written on one line."""
        return not any(
            (index and token.newlines) or "\n" in token.text
            for index, token in enumerate(self.tokens)
        )


def itemized(tokens: list[Token], marks: Marks) -> Body:
    """The items of a file."""
    body, end = _Reader(tokens, marks).body(0)
    assert end == len(tokens)
    return body


class _Reader:
    def __init__(self, tokens: list[Token], marks: Marks) -> None:
        self._tokens = tokens
        self._marks = marks

    def body(self, at: int) -> tuple[Body, int]:
        """The body whose first token (behind the brace) is at `at`, and where it ends."""
        tokens = self._tokens
        body = Body()
        behind = body.behind
        while True:
            at, above, leading = self._comments(at, behind)
            if at == len(tokens) or tokens[at].text == "}":
                body.below = above
                return body, at
            item = Item(above, self._marks.items.get(tokens[at].start), leading)
            at = self._item(item, at)
            body.items.append(item)
            behind = item.behind

    def _comments(self, at: int, behind: list[Token]) -> tuple[int, list[list[Token]], list[Token]]:
        """Share out the comments from `at` on: behind what was before, or above what comes.

        The third are comments on the line on which the next item begins.
        """
        tokens = self._tokens
        lines: list[list[Token]] = []
        first = at
        while at < len(tokens) and tokens[at].is_comment:
            if lines and not tokens[at].newlines:
                lines[-1].append(tokens[at])
            else:
                lines.append([tokens[at]])
            at += 1
        leading: list[Token] = []
        ends = at == len(tokens) or tokens[at].text == "}"
        if lines and not ends and not tokens[at].newlines:
            leading = lines.pop()
        if lines and first > 0 and not tokens[first].newlines:
            behind += lines.pop(0)
        return at, lines, leading

    def _item(self, item: Item, at: int) -> int:
        """Read an item up to where the next one begins, which is returned."""
        tokens, items = self._tokens, self._marks.items
        first = at
        while at < len(tokens):
            token = tokens[at]
            if token.text == "}" or (at > first and token.start in items):
                break
            if token.text == "{":
                item.body, end = self.body(at + 1)
                item.body.tokens = tokens[at : end + 1]
                return end + 1
            item.head.append(token)
            at += 1
        # The comments at its end stand before what comes next.
        while item.head[-1].is_comment:
            item.head.pop()
            at -= 1
        return at
