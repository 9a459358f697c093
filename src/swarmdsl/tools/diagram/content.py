"""Text in boxes and on edges: lines with their places, before anything else has one."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.base.records import dataclass
from swarmdsl.codegen.diagram.graph import Node
from swarmdsl.tools.diagram.measure import LINE_HEIGHTS, SIZES, width, wrapped

PADDING = 10
"""Between text and the border of its box."""
_LINE_MOST, _LABEL_MOST, _NAME_MOST = 250, 170, 300
_INDENT = 10
_MARK = 8
"""The room for the mark of hidden states."""
_RULE = 5
"""Above and below the line between two compartments."""


@dataclass(frozen=True, slots=True)
class Text:
    """A line of text: where its base line is from the top of the block, and how wide it is.

    It begins at `x` or, if that is None, is in the middle of the box, however wide that is. What
    it shows may have an id.
    """

    text: str
    style: str
    x: int | None
    y: int
    width: int
    id: str = ""


@dataclass(frozen=True, slots=True)
class Block:
    """Lines of text in a box; `rules` are lines from side to side, from its top."""

    width: int
    height: int
    texts: tuple[Text, ...]
    rules: tuple[int, ...] = ()


def box_block(node: Node) -> Block:
    """The name in the middle, compartments below it."""
    return _stacked(node, None)


def header_block(node: Node) -> Block:
    """The same for a box with others in it: at the left, so that edges can pass at the right."""
    return _stacked(node, PADDING)


def label_block(pieces: Iterable[str]) -> Block:
    """The label of an edge: pieces that fit on a line stay together."""
    lines: list[str] = []
    for piece in pieces:
        if lines and width(f"{lines[-1]} {piece}", "label") <= _LABEL_MOST:
            lines[-1] += f" {piece}"
        else:
            lines += wrapped(piece, "label", _LABEL_MOST)
    height = LINE_HEIGHTS["label"]
    texts = tuple(
        Text(line, "label", 0, at * height + _base("label"), width(line, "label"))
        for at, line in enumerate(lines)
    )
    return Block(max((text.width for text in texts), default=0), height * len(lines), texts)


def _stacked(node: Node, x: int | None) -> Block:
    texts: list[Text] = []
    rules: list[int] = []
    y = _RULE + 2
    if node.kind == "frame":
        heads = [("name", f"{node.keyword} {node.name}")]
    else:
        heads = [("keyword", f"«{node.keyword}»")] if node.keyword else []
        heads.append(("name", node.name))
    for style, text in heads:
        for line in wrapped(text, style, _NAME_MOST):
            texts.append(Text(line, style, x, y + _base(style), width(line, style)))
            y += LINE_HEIGHTS[style]
    left = sum(map(len, node.compartments))
    for group in node.compartments:
        rules.append(y + _RULE)
        y += 2 * _RULE
        for text in group:
            id_ = node.internal[-left] if left <= len(node.internal) else ""
            left -= 1
            for number, line in enumerate(wrapped(text, "line", _LINE_MOST)):
                indent = _INDENT if number else 0
                base = y + _base("line")
                long = width(line, "line")
                texts.append(Text(line, "line", PADDING + indent, base, long, id_))
                y += LINE_HEIGHTS["line"]
    if node.hides_states:
        y += _MARK
    wide = max(((text.x or PADDING) + text.width for text in texts), default=0)
    return Block(wide + PADDING, y + _RULE + 2, tuple(texts), tuple(rules))


def _base(style: str) -> int:
    """From the top of a line to where its letters stand."""
    return (LINE_HEIGHTS[style] + SIZES[style]) // 2 - 1
