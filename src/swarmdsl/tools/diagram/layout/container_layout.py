"""Layout of one container."""

from __future__ import annotations

from swarmdsl.base.records import dataclass, field
from swarmdsl.tools.diagram.layout.layered_graph import Point
from swarmdsl.tools.diagram.layout.loops import Loop
from swarmdsl.tools.diagram.shapes import Shape


@dataclass
class ContainerLayout:
    """Layout of a container or of a node without children.

    Sizes are along and across; `loops` is the extent of self-loops beyond the box, across.
    Positions are relative to the corner of the box: `crossings` of edges with the border by edge
    number, `pieces` of edges inside, and `labels`. `regions` is True if the children are regions
    that fill the box.
    """

    shape: Shape
    length: int
    breadth: int
    loops: int = 0
    children: dict[str, Point] = field(default_factory=dict)
    crossings: dict[int, int] = field(default_factory=dict)
    segments_of: dict[int, list[Point]] = field(default_factory=dict)
    labels: dict[int, Point] = field(default_factory=dict)
    own_loops: list[Loop] = field(default_factory=list)
    ports: dict[str, Point] = field(default_factory=dict)
    regions: bool = False
