"""Cells to layers, and links to segments from layer to layer."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from swarmdsl.tools.diagram.layout.level import Cell, End, Layers, Link, Segment, Side, Vertex
from swarmdsl.tools.diagram.layout.simplex import minimized

_MOST_PASSED = 20_000
"""Layers that links pass: where it is more, far ones have lanes, as nobody can follow them."""
_NEAR = 4
"""Layers that a link passes which has no lane then."""


def make_layers(cells: Sequence[Cell], links: Sequence[Link], pitch: int) -> Layers:
    """Put each cell in a layer so that links are short; those with a label have a layer for it.

    `pitch` is the distance of a line from the text beside it.
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
        made.segments += _segments(number, link, made, pitch, passed > _MOST_PASSED)
    return made


def _ranks(cells: Sequence[Cell], links: Sequence[Link]) -> list[int]:
    constraints = []
    for link in links:
        tail, head = (link.target, link.source) if link.flipped else (link.source, link.target)
        if tail != head:
            constraints.append((tail, head, link.least, 1))
    title = next((number for number, cell in enumerate(cells) if cell.title), None)
    if title is not None:
        # Beside a title there is only what comes in from outside.
        constraints += (
            (title, number, 1, 0)
            for number, cell in enumerate(cells)
            if cell.border != "first" and number != title
        )
    for border, cell in enumerate(cells):
        # Beside what has a name at the border there is nothing else.
        if cell.border is not None and cell.length:
            ends = (
                (border, number) if cell.border == "first" else (number, border)
                for number, each in enumerate(cells)
                if each.border is None
            )
            constraints += ((tail, head, 1, 0) for tail, head in ends)
    ranks = minimized(len(cells), constraints)
    last = max(ranks, default=0)
    for number, cell in enumerate(cells):
        if cell.border is not None:
            ranks[number] = 0 if cell.border == "first" else last
    return ranks


def _segments(
    number: int, link: Link, layers: Layers, pitch: int, with_lanes: bool
) -> list[Segment]:
    """The way of a link, from its source to its target, with a vertex in each layer between.

    With lanes, a far one has a lane beside them for all but the one with its label.
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
    # Where it must leave on the side that faces away, it first goes round the cell.
    leaves_back = link.source_side not in (None, out)
    enters_back = link.target_side not in (None, into)
    if source is target:
        passed = [source.layer]
    else:
        passed = [*[source.layer] * leaves_back, *passed, *[target.layer] * enters_back]
    way: list[Vertex] = []
    for at, layer in enumerate(passed):
        # Next to the source one sees whose label it is.
        if link.label is not None and at == leaves_back:
            length, breadth = link.label
            vertex = Vertex(length, breadth + pitch, layer, link=number, is_label=True)
        else:
            vertex = Vertex(0, 0, layer, link=number)
        layers.layers[layer].append(vertex)
        way.append(vertex)
    if aside:
        lane = Vertex(0, 0, min(aside), link=number, beyond=len(aside) - 1)
        # After all that is in a layer.
        lane.order = len(layers.cells) + _MOST_PASSED + number
        layers.lanes.append(lane)
        way.insert(len(way) - enters_back, lane)
    stops = [source, *way, target]
    segments = []
    for at, (one, other) in enumerate(pairwise(stops)):
        leaving, entering = out, into
        if leaves_back and at == 0:
            leaving = entering = _other(out)
        elif enters_back and at == len(stops) - 2:
            leaving = entering = _other(into)
        gap = one.layer_at(leaving) + (leaving == "last")
        segments.append(Segment(gap, number, _end(one, leaving), _end(other, entering)))
    segments[0].start.at = link.source_at
    segments[-1].end.at = link.target_at
    return segments


def _other(side: Side) -> Side:
    return "first" if side == "last" else "last"


def _end(vertex: Vertex, side: Side) -> End:
    return End(vertex, side, 0 if vertex.cell is None else None)
