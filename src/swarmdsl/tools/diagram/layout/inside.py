"""The layout of one container, as those around it see it."""

from __future__ import annotations

from swarmdsl.base.records import dataclass, field
from swarmdsl.tools.diagram.layout.level import Point
from swarmdsl.tools.diagram.layout.loops import Loop
from swarmdsl.tools.diagram.shapes import Shape


@dataclass
class Inside:
    """The layout of one container, and of a node without anything inside.

    Sizes are along and across; `loops` is how far loops reach beyond the box, across.
    `crossings` are where edges cross the border, by their number and side; `pieces` the parts
    of edges inside, `labels` the corners of their labels, from the corner of the box. The nodes
    inside are `regions` if they fill it.
    """

    shape: Shape
    length: int
    breadth: int
    loops: int = 0
    children: dict[str, Point] = field(default_factory=dict)
    crossings: dict[int, int] = field(default_factory=dict)
    pieces: dict[int, list[Point]] = field(default_factory=dict)
    labels: dict[int, Point] = field(default_factory=dict)
    own_loops: list[Loop] = field(default_factory=list)
    ports: dict[str, Point] = field(default_factory=dict)
    regions: bool = False
