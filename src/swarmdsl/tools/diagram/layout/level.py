"""What is laid out at once: the nodes in one container and the edges between them, in layers.

Coordinates are (along, across): along the edges, from layer to layer, and across, within a
layer. All are whole numbers of pixels.
"""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.records import dataclass

Side = Literal["first", "last"]
Point = tuple[int, int]


@dataclass
class Cell:
    """A node: its size along and across, and where across edges may end on it.

    One at a `border` is where an edge goes on outside of the container: it is in the first
    or last layer. A `title` is room for text in the first layer, before all others.
    """

    length: int
    breadth: int
    low: int
    high: int
    border: Side | None = None
    title: bool = False


@dataclass
class Link:
    """An edge between cells, by number; `flipped` when it points from a later layer to an earlier.

    It ends at a given place across, or anywhere on the cell; on a given side, or on the one
    that faces the other cell. `label` is the room for text on it, along and across.
    It is `least` layers long.
    """

    source: int
    target: int
    flipped: bool = False
    source_at: int | None = None
    target_at: int | None = None
    source_side: Side | None = None
    target_side: Side | None = None
    label: tuple[int, int] | None = None
    least: int = 1


@dataclass
class Placement:
    """Where everything is: cells, routes of links from source to target, labels.

    Of a cell and of a label it is the corner nearest to (0, 0).
    """

    length: int
    breadth: int
    cells: list[Point]
    routes: list[list[Point]]
    labels: list[Point | None]


@dataclass
class Vertex:
    """A cell, or where a link passes a layer: its number is that of one of them.

    `line` is where the link does, from the corner; there may be room for its label. A lane, on
    which a link passes more layers, is beside them all; so many follow `beyond` the first.
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
        """The layer that it has on a side."""
        return self.layer + (self.beyond or 0) * (side == "last")


@dataclass
class End:
    """Where a segment meets a vertex: on its first or last side, at `at` from its corner."""

    vertex: Vertex
    side: Side
    at: int | None = None

    @property
    def across(self) -> int:
        """Where that is."""
        assert self.at is not None
        return self.vertex.across + self.at


@dataclass
class Segment:
    """The part of a link in gap `gap`, which is before the layer of that number.

    The ends are in the order from the link's source to its target.
    """

    gap: int
    link: int
    start: End
    end: End

    @property
    def turns(self) -> bool:
        """Whether it goes back to the layer that it comes from."""
        return self.start.side == self.end.side

    @property
    def is_aside(self) -> bool:
        """Whether it leads to a lane or from it."""
        return self.start.vertex.beyond is not None or self.end.vertex.beyond is not None


@dataclass
class Layers:
    """The vertices of each layer in their order, the segments between layers, and the lanes."""

    layers: list[list[Vertex]]
    segments: list[Segment]
    cells: list[Vertex]
    lanes: list[Vertex]
