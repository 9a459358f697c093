"""Assign cells to layers and split links into segments between layers."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from swarmdsl.tools.diagram.layout.layered_graph import (
    Cell,
    End,
    Layers,
    Link,
    Segment,
    Side,
    Vertex,
)
from swarmdsl.tools.diagram.layout.simplex import minimize

_MAX_CROSSED = 20_000
"""Number of crossed layers above which long links use lanes beside the layers."""
_NEAR = 4
"""Number of layers that a link may cross without a lane then."""


def make_layers(cells: Sequence[Cell], links: Sequence[Link], pitch: int) -> Layers:
    """Assign layers so that links are short; a label takes a layer of its own.

    `pitch` is the distance of a label from its line.
    """
    ranks = _ranks(cells, links)
    vertices = [
        Vertex(cell.length, cell.breadth, rank, cell=number)
        for number, (cell, rank) in enumerate(zip(cells, ranks, strict=True))
    ]
    layers: list[list[Vertex]] = [[] for _ in range(max(ranks, default=-1) + 1)]
    for vertex in vertices:
        layers[vertex.layer].append(vertex)
    made = Layers(layers, [], vertices, [])
    passed = sum(abs(ranks[link.source] - ranks[link.target]) for link in links)
    for number, link in enumerate(links):
        made.segments += _segments(number, link, made, pitch, passed > _MAX_CROSSED)
    return made


def _ranks(cells: Sequence[Cell], links: Sequence[Link]) -> list[int]:
    constraints = []
    for link in links:
        tail, head = (link.target, link.source) if link.flipped else (link.source, link.target)
        if tail != head:
            constraints.append((tail, head, link.min_layers, 1))
    title = next((number for number, cell in enumerate(cells) if cell.title), None)
    if title is not None:
        # A title shares its layer only with incoming edges.
        constraints += (
            (title, number, 1, 0)
            for number, cell in enumerate(cells)
            if cell.border != "first" and number != title
        )
    for border, cell in enumerate(cells):
        # A border cell with a name has the layer for itself.
        if cell.border is not None and cell.length:
            ends = (
                (border, number) if cell.border == "first" else (number, border)
                for number, each in enumerate(cells)
                if each.border is None
            )
            constraints += ((tail, head, 1, 0) for tail, head in ends)
    ranks = minimize(len(cells), constraints)
    last = max(ranks, default=0)
    for number, cell in enumerate(cells):
        if cell.border is not None:
            ranks[number] = 0 if cell.border == "first" else last
    return ranks


def _segments(
    number: int, link: Link, layers: Layers, pitch: int, with_lanes: bool
) -> list[Segment]:
    """Segments of a link from source to target, with a vertex in each layer between.

    With lanes, a long link uses a lane for all layers except that of its label.
    """
    source, target = layers.cells[link.source], layers.cells[link.target]
    step = -1 if link.flipped else 1
    out: Side = "first" if link.flipped else "last"
    into: Side = "last" if link.flipped else "first"
    passed = list(range(source.layer + step, target.layer, step))
    aside: list[int] = []
    if with_lanes and len(passed) > _NEAR:
        labels = link.label is not None
        passed, aside = passed[:labels], passed[labels:]
    # A link that leaves or enters on the far side first goes around the cell.
    leaves_back = link.source_side not in (None, out)
    enters_back = link.target_side not in (None, into)
    if source is target:
        passed = [source.layer]
    else:
        passed = [*[source.layer] * leaves_back, *passed, *[target.layer] * enters_back]
    way: list[Vertex] = []
    for at, layer in enumerate(passed):
        # Put the label next to the source.
        if link.label is not None and at == leaves_back:
            length, breadth = link.label
            vertex = Vertex(length, breadth + pitch, layer, link=number, is_label=True)
        else:
            vertex = Vertex(0, 0, layer, link=number)
        layers.layers[layer].append(vertex)
        way.append(vertex)
    if aside:
        lane = Vertex(0, 0, min(aside), link=number, beyond=len(aside) - 1)
        # After all vertices of the layer.
        lane.order = len(layers.cells) + _MAX_CROSSED + number
        layers.lanes.append(lane)
        way.insert(len(way) - enters_back, lane)
    stops = [source, *way, target]
    segments = []
    for at, (one, other) in enumerate(pairwise(stops)):
        leaving, entering = out, into
        if leaves_back and at == 0:
            leaving = entering = _opposite(out)
        elif enters_back and at == len(stops) - 2:
            leaving = entering = _opposite(into)
        gap = one.layer_at(leaving) + (leaving == "last")
        segments.append(Segment(gap, number, _end(one, leaving), _end(other, entering)))
    segments[0].start.at = link.source_at
    segments[-1].end.at = link.target_at
    return segments


def _opposite(side: Side) -> Side:
    return "first" if side == "last" else "last"


def _end(vertex: Vertex, side: Side) -> End:
    return End(vertex, side, 0 if vertex.cell is None else None)
