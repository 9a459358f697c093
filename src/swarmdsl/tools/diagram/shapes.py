"""Shapes of nodes: size, port positions and text."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from swarmdsl.base.records import dataclass, replace
from swarmdsl.codegen.diagram.graph import Node, Port
from swarmdsl.tools.diagram.measure import LINE_HEIGHTS, width
from swarmdsl.tools.diagram.text_blocks import Block, TextLine, box_block, header_block

Direction = Literal["down", "right"]
PSEUDO_STATES = {"initial": 14, "final": 20, "choice": 26, "history": 22, "deep history": 22}
"""Diameters of pseudostates; their names are beside them."""
_MIN_WIDTH, _MIN_HEIGHT = 64, 36
_NAME_GAP = 4
PORT = 10
"""Side length of the square of a port."""
_PORT_ROW = 20
_PORTS_GAP = 24
"""Space between the port names on the left and on the right."""


@dataclass(frozen=True, slots=True)
class Shape:
    """Shape of a node without its children.

    `core` is the (x, y, width, height) on which edges end. `ports` are the ids and centers of
    ports, relative to the top left corner.
    """

    width: int
    height: int
    core: tuple[int, int, int, int]
    block: Block
    ports: tuple[tuple[str, int, int], ...] = ()


def shape_of(node: Node, direction: Direction, right_ports: set[str]) -> Shape:
    """Shape of a node for a layout direction.

    `right_ports` are on the right side, other ports on the left. The shape of a container is only
    its header.
    """
    if node.kind in PSEUDO_STATES:
        return _pseudo_state(node, direction)
    if node.nodes or node.kind == "frame":
        block = header_block(node)
        return Shape(block.width, block.height, (0, 0, block.width, block.height), block)
    block = box_block(node)
    if node.ports:
        return _with_ports(node.ports, block, right_ports)
    shape = Shape(block.width, block.height, (0, 0, block.width, block.height), block)
    return resized(shape, max(block.width, _MIN_WIDTH), max(block.height, _MIN_HEIGHT))


def resized(shape: Shape, wide: int, high: int) -> Shape:
    """Resize a box; a name without compartments stays centered."""
    block = shape.block
    if not block.rules:
        block = _shifted(block, (high - shape.height) // 2)
    return Shape(wide, high, (0, 0, wide, high), block)


def with_indent(shape: Shape, indent: int) -> Shape:
    """Move the header of a container to the right."""
    block = shape.block
    texts = tuple(replace(each, x=(each.x or 0) + indent) for each in block.texts)
    wide = block.width + indent
    moved = Block(wide, block.height, texts, block.rules)
    return Shape(wide, shape.height, (0, 0, wide, shape.height), moved, shape.ports)


def _pseudo_state(node: Node, direction: Direction) -> Shape:
    """Circle or diamond with its name on a side without edges."""
    size = PSEUDO_STATES[node.kind]
    if not node.name:
        return Shape(size, size, (0, 0, size, size), Block(0, 0, ()))
    wide = width(node.name, "line")
    if direction == "down":
        text = TextLine(node.name, "line", size + _NAME_GAP, size // 2 + 4, wide)
        total = size + _NAME_GAP + wide
        return Shape(total, size, (0, 0, size, size), Block(total, size, (text,)))
    total, high = max(size, wide), size + LINE_HEIGHTS["line"] + 2
    total += (total - size) % 2
    text = TextLine(node.name, "line", (total - wide) // 2, high - 4, wide)
    core = ((total - size) // 2, 0, size, size)
    return Shape(total, high, core, Block(total, high, (text,)))


def _with_ports(ports: Sequence[Port], block: Block, right: set[str]) -> Shape:
    """Box with ports below all other text, each with its name and type inside."""
    texts: list[TextLine] = list(block.texts)
    names = {port.id: port_text(port) for port in ports}
    sides = ([p for p in ports if p.id not in right], [p for p in ports if p.id in right])
    widest = [max((width(names[p.id], "line") for p in side), default=0) for side in sides]
    gap = _PORTS_GAP if all(sides) else 0
    inset = PORT // 2 + 5
    wide = max(block.width, _MIN_WIDTH, sum(widest) + gap + 2 * inset)
    centres = []
    for at_right, side in enumerate(sides):
        for row, port in enumerate(side):
            y = block.height + _PORT_ROW * row + _PORT_ROW // 2
            long = width(names[port.id], "line")
            x = wide - inset - long if at_right else inset
            texts.append(TextLine(names[port.id], "line", x, y + 4, long))
            centres.append((port.id, wide if at_right else 0, y))
    high = block.height + _PORT_ROW * max(map(len, sides)) + 6
    rules = (*block.rules, block.height - 2)
    return Shape(
        wide, high, (0, 0, wide, high), Block(wide, high, tuple(texts), rules), tuple(centres)
    )


def port_text(port: Port) -> str:
    """Label of a port."""
    return f"{port.name} : {port.type}"


def _shifted(block: Block, down: int) -> Block:
    texts = tuple(replace(each, y=each.y + down) for each in block.texts)
    return Block(block.width, block.height, texts, block.rules)
