"""Layered graph of one container: nodes, edges and layers.

Coordinates are (along, across): along the edges, from layer to layer, and across, within a layer.
All are integers, in pixels.
"""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.records import dataclass

Side = Literal["first", "last"]
Point = tuple[int, int]


@dataclass
class Cell:
    """A node: its size along and across, and the range across in which edges may end.

    A cell at a `border` continues an edge outside of the container; it is in the first or last
    layer. A `title` reserves space for text at the start of the first layer. No edge ends in a
    `barred` part, from the first to the second position across, on one side or on both.
    """

    length: int
    breadth: int
    low: int
    high: int
    border: Side | None = None
    title: bool = False
    barred: tuple[tuple[int, int, Side | None], ...] = ()


@dataclass
class Link:
    """An edge between cells, by number; `flipped` if it points to an earlier layer.

    Ends are at a given position across, or anywhere on the cell, and on a given side, or on the
    side that faces the other cell. `label` is the size of its text along and across. The link spans
    at least `least` layers.
    """

    source: int
    target: int
    flipped: bool = False
    source_at: int | None = None
    target_at: int | None = None
    source_side: Side | None = None
    target_side: Side | None = None
    label: tuple[int, int] | None = None
    min_layers: int = 1


@dataclass
class Placement:
    """Positions of cells, links and labels.

    Routes of links run from source to target. The position of a cell or label is its corner nearest
    to (0, 0).
    """

    length: int
    breadth: int
    cells: list[Point]
    routes: list[list[Point]]
    labels: list[Point | None]


@dataclass(eq=False)
class Vertex:
    """A cell, or the crossing of a link with a layer.

    `line` is the position of the link relative to the corner; a label takes the rest. A lane, on
    which a link crosses several layers, is beside all layers and spans `beyond` more than one.
    """

    length: int
    breadth: int
    layer: int
    cell: int | None = None
    link: int | None = None
    line: int = 0
    is_label: bool = False
    across: int = 0
    order: int = 0
    beyond: int | None = None

    def layer_at(self, side: Side) -> int:
        """Layer of the vertex on a side."""
        return self.layer + (self.beyond or 0) * (side == "last")


@dataclass(eq=False)
class End:
    """End of a segment on a side of a vertex, at `at` from its corner."""

    vertex: Vertex
    side: Side
    at: int | None = None

    @property
    def across(self) -> int:
        """Position across."""
        assert self.at is not None
        return self.vertex.across + self.at


@dataclass(eq=False)
class Segment:
    """Part of a link in gap `gap`, which precedes the layer of that number.

    The ends are ordered from the source of the link to its target. A part of a lane between two
    rows is `fixed`: it stays straight, so that the rows are apart.
    """

    gap: int
    link: int
    start: End
    end: End
    fixed: bool = False

    @property
    def turns(self) -> bool:
        """True if the segment returns to the layer that it comes from."""
        return self.start.side == self.end.side

    @property
    def uses_lane(self) -> bool:
        """True if the segment begins or ends at a lane."""
        return self.start.vertex.beyond is not None or self.end.vertex.beyond is not None


@dataclass
class Layers:
    """Ordered vertices of each layer, segments between layers, and lanes."""

    layers: list[list[Vertex]]
    segments: list[Segment]
    cells: list[Vertex]
    lanes: list[Vertex]


@dataclass
class LayerPositions:
    """Start and length of each layer along, and the total length."""

    starts: list[int]
    lengths: list[int]
    end: int
    in_row: bool

    def cell(self, cell: Cell, layer: int, length: int) -> int:
        """Position of a cell in its layer or at the border."""
        if cell.border == "first":
            return 0
        if cell.border == "last":
            return self.end - length
        return self.starts[layer] if self.in_row else self.middle(layer, length)

    def middle(self, layer: int, length: int) -> int:
        """Position of something in the middle of a layer."""
        return self.starts[layer] + (self.lengths[layer] - length) // 2
