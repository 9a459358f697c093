"""Lay out items on lines: bodies, indentation, blank lines."""

from __future__ import annotations

from itertools import zip_longest

from swarmdsl.syntax.ast import (
    DeliverySetting,
    EnumValue,
    ImportFile,
    ImportLibrary,
    ImportRos,
    Node,
    PartValue,
    Transition,
)
from swarmdsl.syntax.formatter.columns import align, set_cells
from swarmdsl.syntax.formatter.items import Body, Item
from swarmdsl.syntax.formatter.lines import INDENT, WIDTH, Line
from swarmdsl.syntax.formatter.marks import Marks
from swarmdsl.syntax.formatter.separators import with_commas
from swarmdsl.syntax.formatter.spacing import join_tokens
from swarmdsl.syntax.formatter.tokens import Token
from swarmdsl.syntax.formatter.wrapping import wrap

_IMPORTS = (ImportFile, ImportRos, ImportLibrary)


def lay_out(file: Body, marks: Marks) -> list[Line]:
    """Lay out a file."""
    lines: list[Line] = []
    before: tuple[Node | None, int] | None = None
    for item in file.items:
        above, own = _comment_lines(item.above, 0), _item_lines(item, 0, marks)
        unit = above + own
        this = (item.node, len(own) + own[0].text.count("\n"))
        if before and not _belong_together(before, this):
            unit[0].blank_above |= not any(line.blank_above for line in (*above, own[0]))
        before = this
        lines += unit
    below = _comment_lines(file.below, 0)
    if below and before and before[1] > 1:
        below[0].blank_above |= not any(line.blank_above for line in below)
    lines += below
    if lines:
        lines[0].blank_above = False
    align(lines)
    return lines


def _belong_together(one: tuple[Node | None, int], other: tuple[Node | None, int]) -> bool:
    """Return True if no blank line separates two neighbours: one line each, of one kind."""
    (node, height), (next_node, next_height) = one, other
    both_imports = isinstance(node, _IMPORTS) and isinstance(next_node, _IMPORTS)
    return height == next_height == 1 and (both_imports or type(node) is type(next_node))


def _comment_lines(comments: list[list[Token]], indent: int) -> list[Line]:
    return [
        Line(
            indent,
            " ".join(_reindent(comment.text, indent) for comment in line),
            blank_above=line[0].newlines > 1,
            is_comment=True,
        )
        for line in comments
    ]


def _reindent(comment: str, indent: int) -> str:
    """Align the `*` at the start of each line of a block comment."""
    first, *others = (line.rstrip() for line in comment.split("\n"))
    if all(line.lstrip().startswith("*") for line in others):
        others = [f"{' ' * indent} {line.lstrip()}" for line in others]
    return "\n".join((first, *others))


def _item_lines(item: Item, indent: int, marks: Marks) -> list[Line]:
    body = item.body
    if body is None:
        lines = wrap(item.head, indent, marks)
        if len(lines) == 1:
            _set_cells(lines[0], item, item.head, marks)
    else:
        whole = [*item.head, *with_commas(body.tokens, marks)]
        if _stays_on_one_line(body) and _fits(whole, indent, marks):
            lines = wrap(whole, indent, marks)
            _set_cells(lines[0], item, whole, marks)
        else:
            lines = wrap([*item.head, body.tokens[0]], indent, marks)
            lines[-1].trailing += _trailing(body.trailing)
            lines += _body_lines(body, indent + INDENT, marks)
            lines.append(Line(indent, "}"))
    lines[-1].trailing += _trailing(item.trailing)
    lines[0].blank_above = item.head[0].newlines > 1
    return lines


def _body_lines(body: Body, indent: int, marks: Marks) -> list[Line]:
    lines: list[Line] = []
    for item, following in zip_longest(body.items, body.items[1:]):
        lines += _comment_lines(item.above, indent)
        lines += _item_lines(item, indent, marks)
        if _needs_separator(item, following):
            lines[-1].text += ";"
    lines += _comment_lines(body.below, indent)
    if lines:
        lines[0].blank_above = False
    return lines


def _needs_separator(item: Item, following: Item | None) -> bool:
    """Return True if a guard on the next line would belong to the outcomes before it."""
    match item.node:
        case Transition(effects=[], target=None):
            return following is not None and following.head[0].text == "["
    return False


def _stays_on_one_line(body: Body) -> bool:
    """Return True for a body that may stay on one line: empty, with one item, or of values."""
    if len(body.tokens) == 2:
        return True
    values = all(
        isinstance(item.node, (PartValue, EnumValue, DeliverySetting)) for item in body.items
    )
    few = len(body.items) <= 1 or values
    inner = (item.body for item in body.items if item.body is not None)
    return few and body.on_one_line and all(map(_stays_on_one_line, inner))


def _fits(tokens: list[Token], indent: int, marks: Marks) -> bool:
    lines = wrap(tokens, indent, marks)
    return len(lines) == 1 and indent + len(lines[0].text) <= WIDTH


def _trailing(comments: list[Token]) -> str:
    text = " ".join(comment.text for comment in comments)
    return f"  {text}" if text else ""


def _set_cells(line: Line, item: Item, tokens: list[Token], marks: Marks) -> None:
    if "\n" not in line.text:
        _, starts = join_tokens(tokens, marks.tight)
        set_cells(line, item.node, tokens, starts)
