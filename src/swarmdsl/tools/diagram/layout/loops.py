"""Self-loops, on a side of the node without other edges."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.base.records import dataclass
from swarmdsl.tools.diagram.shapes import Direction
from swarmdsl.tools.diagram.text_blocks import Block

_REACH = 22
"""Extent of a loop to the right."""
_LEAST = 18
_GAP = 6
_CORNER = 14


@dataclass
class Loop:
    """A self-loop: corners and label as (x, y) from the top left corner of the node."""

    edge: int
    points: list[tuple[int, int]]
    label: tuple[int, int] | None


def loop_room(
    loops: Sequence[tuple[int, Block | None]], wide: int, high: int, direction: Direction
) -> tuple[int, int, int, list[Loop]]:
    """Size of a node with space for loops, their extent beyond it, and the loops.

    Loops are pairs of edge number and label. They are stacked on the right in a downward layout,
    otherwise nested below the node.
    """
    if not loops:
        return wide, high, 0, []
    if direction == "down":
        return _at_right(loops, wide, high)
    return _below(loops, wide, high)


def _at_right(
    loops: Sequence[tuple[int, Block | None]], wide: int, high: int
) -> tuple[int, int, int, list[Loop]]:
    heights = [max(_LEAST, block.height if block is not None else 0) for _, block in loops]
    high = max(high, sum(heights) + _GAP * (len(loops) - 1) + 2 * _CORNER)
    y = (high - sum(heights) - _GAP * (len(loops) - 1)) // 2
    found = []
    reach = 0
    for (edge, block), height in zip(loops, heights, strict=True):
        points = [(wide, y), (wide + _REACH, y), (wide + _REACH, y + height), (wide, y + height)]
        label = None
        if block is not None:
            label = (wide + _REACH + _GAP, y + (height - block.height) // 2)
            reach = max(reach, block.width + _GAP)
        found.append(Loop(edge, points, label))
        y += height + _GAP
    return wide, high, _REACH + reach, found


def _below(
    loops: Sequence[tuple[int, Block | None]], wide: int, high: int
) -> tuple[int, int, int, list[Loop]]:
    count = len(loops)
    for at, (_, block) in enumerate(loops):
        if block is not None:
            inset = _CORNER + 8 * (count - 1 - at)
            wide = max(wide, block.width + 2 * inset + 2 * _GAP)
    found = []
    depth = 0
    for at, (edge, block) in enumerate(loops):
        inset = _CORNER + 8 * (count - 1 - at)
        depth += (block.height if block is not None else 0) + _GAP + (10 if not at else 4)
        left, right, low = inset, wide - inset, high + depth
        label = None
        if block is not None:
            label = (left + (right - left - block.width) // 2, low - block.height - 3)
        found.append(Loop(edge, [(right, high), (right, low), (left, low), (left, high)], label))
    return wide, high, depth, found
