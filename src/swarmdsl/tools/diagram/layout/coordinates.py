"""Assign coordinates across to vertices and edge ends."""

from __future__ import annotations

from collections.abc import Sequence
from heapq import heappop, heappush

from swarmdsl.tools.diagram.layout.cell_sides import CellSide, cell_sides
from swarmdsl.tools.diagram.layout.chains import LINE_GAP
from swarmdsl.tools.diagram.layout.layered_graph import Cell, Layers, Link
from swarmdsl.tools.diagram.layout.straightening import Straightener


def assign_coordinates(
    layers: Layers, cells: Sequence[Cell], links: Sequence[Link], pitch: int, before: bool
) -> None:
    """Set the positions of vertices and ends across.

    `before` selects the side for the label of an edge with as many others on either side.
    """
    sides = cell_sides(layers, cells)
    _choose_label_sides(sides, layers, links, pitch, before)
    for ends in sides:
        ends.spread()
    Straightener(layers, sides).place()
    _place_lanes(layers)
    for side in sides:
        side.straighten()


def _place_lanes(layers: Layers) -> None:
    """Place lanes beside everything else; lanes that are far apart share a position."""
    if not layers.lanes:
        return
    across = max((v.across + v.breadth for layer in layers.layers for v in layer), default=0)
    taken: list[tuple[int, int]] = []  # heap of (last layer, place)
    free: list[int] = []
    places = 0
    for lane in sorted(layers.lanes, key=lambda each: (each.layer, each.beyond)):
        # Edges to one lane and from the next must be in different gaps.
        while taken and taken[0][0] + 1 < lane.layer:
            heappush(free, heappop(taken)[1])
        places += not free
        place = heappop(free) if free else places
        heappush(taken, (lane.layer_at("last"), place))
        lane.across = across + place * LINE_GAP


def _choose_label_sides(
    sides: Sequence[CellSide], layers: Layers, links: Sequence[Link], pitch: int, before: bool
) -> None:
    """Put each label on the side of its line that faces away from other edges."""
    labels = {vertex.link: vertex for layer in layers.layers for vertex in layer if vertex.is_label}
    for side in sides:
        labelled = [
            at
            for at, (end, number) in enumerate(zip(side.ends, side.links, strict=True))
            if number in labels and links[number].source == end.vertex.cell
        ]
        turned = (len(labelled) + before) // 2
        if len(labelled) == 1 < len(side.ends) and labelled[0] in (0, len(side.ends) - 1):
            turned = int(labelled[0] == 0)
        for at in labelled[:turned]:
            vertex = labels[side.links[at]]
            vertex.line = vertex.breadth
    for segment in layers.segments:
        for end in (segment.start, segment.end):
            if end.vertex.is_label:
                end.at = end.vertex.line
