"""Group tokens into items, which go on lines of their own, with their comments."""

from __future__ import annotations

from swarmdsl.base.records import dataclass, field
from swarmdsl.syntax.ast import Node
from swarmdsl.syntax.formatter.marks import Marks
from swarmdsl.syntax.formatter.tokens import Token


@dataclass(slots=True)
class Item:
    """Declaration, statement or the like.

    `above` are the lines of comments before it; `head` are its tokens without its body; `trailing`
    are the comments on its last line. `node` is None for the sections of services and actions, and
    for the end of a body.
    """

    above: list[list[Token]]
    node: Node | None = None
    head: list[Token] = field(default_factory=list)
    body: Body | None = None
    trailing: list[Token] = field(default_factory=list)


@dataclass(slots=True)
class Body:
    """Body in braces, or the file.

    `tokens` are all its tokens with the braces, `trailing` the comments after the opening brace,
    `below` the lines of comments before the closing one.
    """

    tokens: list[Token] = field(default_factory=list)
    trailing: list[Token] = field(default_factory=list)
    items: list[Item] = field(default_factory=list)
    below: list[list[Token]] = field(default_factory=list)

    @property
    def on_one_line(self) -> bool:
        """Return True if the source has it on one line."""
        return not any(
            (index and token.newlines) or "\n" in token.text
            for index, token in enumerate(self.tokens)
        )


def group_items(tokens: list[Token], marks: Marks) -> Body:
    """Group the tokens of a file into items."""
    body, end = _Reader(tokens, marks).body(0)
    assert end == len(tokens)
    return body


class _Reader:
    def __init__(self, tokens: list[Token], marks: Marks) -> None:
        self._tokens = tokens
        self._marks = marks

    def body(self, at: int) -> tuple[Body, int]:
        """Read the body whose first token after the brace is at `at`; return its end too."""
        tokens = self._tokens
        body = Body()
        trailing = body.trailing
        while True:
            at, above, leading = self._comments(at, trailing)
            if at == len(tokens) or tokens[at].text == "}":
                body.below = above
                return body, at
            item = Item(above, self._marks.items.get(tokens[at].start), leading)
            at = self._item(item, at)
            body.items.append(item)
            trailing = item.trailing

    def _comments(
        self, at: int, trailing: list[Token]
    ) -> tuple[int, list[list[Token]], list[Token]]:
        """Assign the comments from `at` on: trailing the item before, or above the next one.

        The third result are comments at the start of the line of the next item. Those before a
        separator are none of them.
        """
        tokens = self._tokens
        lines: list[list[Token]] = []
        first = at
        bound = 0  # lines before the separator
        while at < len(tokens) and tokens[at].is_comment:
            separated = tokens[at].start in self._marks.separated
            if separated:
                bound = len(lines)
            if lines and not tokens[at].newlines and not separated:
                lines[-1].append(tokens[at])
            else:
                lines.append([tokens[at]])
            at += 1
        leading: list[Token] = []
        ends = at == len(tokens) or tokens[at].text == "}"
        if not ends and tokens[at].start in self._marks.separated:
            bound = len(lines)
        if len(lines) > bound and not ends and not tokens[at].newlines:
            leading = lines.pop()
        if lines and first > 0 and not tokens[first].newlines:
            trailing += lines.pop(0)
        return at, lines, leading

    def _item(self, item: Item, at: int) -> int:
        """Read an item; return the index of the next one."""
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
        # Comments at the end belong to the next item.
        while item.head[-1].is_comment:
            item.head.pop()
            at -= 1
        return at
