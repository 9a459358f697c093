"""Text lines in boxes and on edges, with positions relative to their block."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.base.records import dataclass
from swarmdsl.codegen.diagram.graph import Node
from swarmdsl.tools.diagram.measure import LINE_HEIGHTS, SIZES, width, wrap

PADDING = 10
"""Distance between the text and the border of its box."""
_MAX_LINE_WIDTH, _MAX_LABEL_WIDTH, _MAX_NAME_WIDTH = 250, 170, 300
_INDENT = 10
_MARK_HEIGHT = 8
"""Height of the mark for hidden states."""
_RULE_GAP = 5
"""Space above and below the line between two compartments."""


@dataclass(frozen=True, slots=True)
class TextLine:
    """A line of text: the baseline `y` from the top of the block, and its width.

    If `x` is None, the line is centered in the box. `id` is the id of the element that it shows, if
    any.
    """

    text: str
    style: str
    x: int | None
    y: int
    width: int
    id: str = ""


@dataclass(frozen=True, slots=True)
class Block:
    """Lines of text in a box; `rules` are the positions of horizontal lines."""

    width: int
    height: int
    texts: tuple[TextLine, ...]
    rules: tuple[int, ...] = ()


def box_block(node: Node) -> Block:
    """Text of a box: a centered name and compartments below."""
    return _text_block(node, None)


def header_block(node: Node) -> Block:
    """Text of a container, left-aligned so that edges can pass on the right."""
    return _text_block(node, PADDING)


def label_block(parts: Iterable[str]) -> Block:
    """Label of an edge, broken between parts if they do not fit on a line."""
    lines: list[str] = []
    for part in parts:
        if lines and width(f"{lines[-1]} {part}", "label") <= _MAX_LABEL_WIDTH:
            lines[-1] += f" {part}"
        else:
            lines += wrap(part, "label", _MAX_LABEL_WIDTH)
    height = LINE_HEIGHTS["label"]
    texts = tuple(
        TextLine(line, "label", 0, at * height + _baseline("label"), width(line, "label"))
        for at, line in enumerate(lines)
    )
    return Block(max((text.width for text in texts), default=0), height * len(lines), texts)


def _text_block(node: Node, x: int | None) -> Block:
    texts: list[TextLine] = []
    rules: list[int] = []
    y = _RULE_GAP + 2
    if node.kind == "frame":
        heads = [("name", f"{node.keyword} {node.name}")]
    else:
        heads = [("keyword", f"«{node.keyword}»")] if node.keyword else []
        heads.append(("name", node.name))
    for style, text in heads:
        for line in wrap(text, style, _MAX_NAME_WIDTH):
            texts.append(TextLine(line, style, x, y + _baseline(style), width(line, style)))
            y += LINE_HEIGHTS[style]
    left = sum(map(len, node.compartments))
    for group in node.compartments:
        rules.append(y + _RULE_GAP)
        y += 2 * _RULE_GAP
        for text in group:
            id_ = node.internal[-left] if left <= len(node.internal) else ""
            left -= 1
            for number, line in enumerate(wrap(text, "line", _MAX_LINE_WIDTH)):
                indent = _INDENT if number else 0
                baseline = y + _baseline("line")
                line_width = width(line, "line")
                texts.append(TextLine(line, "line", PADDING + indent, baseline, line_width, id_))
                y += LINE_HEIGHTS["line"]
    if node.hides_states:
        y += _MARK_HEIGHT
    text_width = max(((text.x or PADDING) + text.width for text in texts), default=0)
    return Block(text_width + PADDING, y + _RULE_GAP + 2, tuple(texts), tuple(rules))


def _baseline(style: str) -> int:
    """Distance from the top of a line to its baseline."""
    return (LINE_HEIGHTS[style] + SIZES[style]) // 2 - 1
