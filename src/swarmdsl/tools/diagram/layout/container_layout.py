"""Layout of one container."""

from __future__ import annotations

from swarmdsl.base.records import dataclass, field
from swarmdsl.tools.diagram.layout.layered_graph import Point, Side
from swarmdsl.tools.diagram.layout.loops import Loop
from swarmdsl.tools.diagram.shapes import Direction, Shape


@dataclass
class ContainerLayout:
    """Layout of a container or of a node without children.

    Positions are (x, y), relative to the corner of the box: `children`, the segments of edges
    inside, labels and ports. `crossings` are the positions at which edges cross the border, on the
    sides that face other nodes, and `arrows` those of arrow heads that meet it from inside. `loops`
    is the extent of self-loops beyond the box. `regions` is True if the children are regions that
    fill the box, one beside the other across `direction`.
    """

    shape: Shape
    width: int
    height: int
    direction: Direction
    loops: int = 0
    children: dict[str, Point] = field(default_factory=dict)
    crossings: dict[int, int] = field(default_factory=dict)
    arrows: list[tuple[int, Side]] = field(default_factory=list)
    segments_of: dict[int, list[Point]] = field(default_factory=dict)
    labels: dict[int, Point] = field(default_factory=dict)
    own_loops: list[Loop] = field(default_factory=list)
    ports: dict[str, Point] = field(default_factory=dict)
    regions: bool = False


def along_across(direction: Direction, wide: int, high: int) -> Point:
    """Convert (x, y) to (along, across), or back."""
    return (high, wide) if direction == "down" else (wide, high)
