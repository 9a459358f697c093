"""Assign coordinates across to vertices and edge ends.

Inner segments of a link form one straight line wherever possible. The coordinates of lines and
cells minimize the weighted bends of edges: Gansner et al. 1993, section 4, with one number for the
inner segments of a link, as in Sander: Layout of Compound Directed Graphs (1996), section 6.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from heapq import heappop, heappush
from itertools import pairwise

from swarmdsl.tools.diagram.layout.cell_sides import CellSide, cell_sides
from swarmdsl.tools.diagram.layout.layered_graph import Cell, End, Layers, Link, Segment, Vertex
from swarmdsl.tools.diagram.layout.simplex import Constraint, minimize

NODE_GAP, LINE_GAP, LABEL_GAP = 26, 12, 12


def assign_coordinates(
    layers: Layers, cells: Sequence[Cell], links: Sequence[Link], pitch: int, before: bool
) -> None:
    """Set the positions of vertices and ends across.

    `before` selects the side for the label of a single edge, or of the middle one.
    """
    sides = cell_sides(layers, cells)
    _choose_label_sides(sides, layers, links, pitch, before)
    for ends in sides:
        ends.spread()
    lines = _lines(layers)
    _minimize(layers, lines, sides)
    _place_lanes(layers)
    for side in sides:
        side.straighten()


def _minimize(layers: Layers, lines: Sequence[Sequence[Vertex]], sides: Sequence[CellSide]) -> None:
    """Place all lines and ends so that edges are as straight as possible, starting at 0.

    An end has a number of its own, between bounds that depend on that of its cell. A slight
    preference for even spacing on the cell is part of the cost.
    """
    number = {id(vertex): at for at, line in enumerate(lines) for vertex in line}
    constraints: list[Constraint] = []
    for layer in layers.layers:
        for one, other in pairwise(layer):
            room = one.breadth - one.line + other.line + _gap(one, other)
            constraints.append((number[id(one)], number[id(other)], room, 0))
    places = _packed(len(lines), constraints)
    in_lane = {
        id(end)
        for segment in layers.segments
        if segment.uses_lane
        for end in (segment.start, segment.end)
    }
    end_number: dict[int, int] = {}
    for side in sides:
        for run, low, high, gap in side.runs:
            cell = number[id(side.ends[run[0]].vertex)]
            before = None
            for at in run:
                end = side.ends[at]
                assert end.at is not None
                end_number[id(end)] = this = len(places)
                places.append(places[cell] + end.at)
                if before is None:
                    constraints.append((cell, this, low, 0))
                else:
                    constraints.append((before, this, gap, 0))
                before = this
            assert before is not None
            constraints.append((before, cell, -high, 0))
    preferred = dict(end_number)

    def place_between(one: int, other: int, offset: int, weight: int) -> None:
        """Add the cost of a difference other than `offset`, for `other` below `one`."""
        to_one, to_other = max(0, -offset), max(0, offset)
        # Number `places` of the pair is below both.
        this = len(places)
        constraints.append((this, one, to_one, weight))
        constraints.append((this, other, to_other, weight))
        places.append(min(places[one] - to_one, places[other] - to_other))

    for segment in layers.segments:
        start, end = segment.start, segment.end
        if segment.uses_lane:
            continue
        ends = []
        offset = 0
        for each, sign in ((start, 1), (end, -1)):
            if id(each) in end_number:
                ends.append(end_number[id(each)])
            else:
                ends.append(number[id(each.vertex)])
                offset += sign * _offset(each)
        if ends[0] != ends[1]:
            place_between(ends[0], ends[1], offset, _weight(segment))
    for side in sides:
        for end in side.ends:
            if id(end) in preferred and id(end) not in in_lane:
                assert end.at is not None
                place_between(number[id(end.vertex)], preferred[id(end)], end.at, 1)
    found = minimize(len(places), constraints, places)
    for at, line in enumerate(lines):
        for vertex in line:
            vertex.across = found[at] - vertex.line
    for side in sides:
        for end in side.ends:
            if id(end) in end_number:
                end.at = found[end_number[id(end)]] - end.vertex.across
    least = min((v.across for layer in layers.layers for v in layer), default=0)
    for layer in layers.layers:
        for vertex in layer:
            vertex.across -= least


def _packed(count: int, constraints: Sequence[Constraint]) -> list[int]:
    """Return the smallest places that satisfy the constraints."""
    after: list[list[tuple[int, int]]] = [[] for _ in range(count)]
    waits = [0] * count
    for tail, head, length, _ in constraints:
        after[tail].append((head, length))
        waits[head] += 1
    places = [0] * count
    ready = [each for each in range(count) if not waits[each]]
    for each in ready:
        for head, length in after[each]:
            places[head] = max(places[head], places[each] + length)
            waits[head] -= 1
            if not waits[head]:
                ready.append(head)
    return places


def _place_lanes(layers: Layers) -> None:
    """Place lanes beside everything else; lanes that are far apart share a position."""
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


def _offset(end: End) -> int:
    """Offset of an end from the variable of its vertex."""
    assert end.at is not None
    return end.at - end.vertex.line


def _gap(one: Vertex, other: Vertex) -> int:
    nodes = _takes_space(one) + _takes_space(other)
    if nodes == 2:
        return NODE_GAP
    return LABEL_GAP if nodes or one.is_label or other.is_label else LINE_GAP


def _takes_space(vertex: Vertex) -> bool:
    """Return True for a cell that takes space, False for a continuation at the border."""
    return vertex.cell is not None and vertex.breadth > 0


def _weight(segment: Segment) -> int:
    """Cost per pixel of bend in a segment.

    Lower at a cell, lowest at the target of the link: a necessary bend is a single one, away from
    the label.
    """
    if segment.turns:
        return 1  # it always bends
    start, end = _takes_space(segment.start.vertex), _takes_space(segment.end.vertex)
    if start and end:
        return 24
    if not (start or end):
        return 64
    return 20 if start else 18


def _lines(layers: Layers) -> list[list[Vertex]]:
    """Vertices with the same coordinate across: cells, and inner parts of links.

    If inner parts of two links cross, one is interrupted.
    """
    line_of: dict[int, list[Vertex]] = {
        id(vertex): [vertex] for layer in layers.layers for vertex in layer
    }
    gaps: dict[int, list[tuple[Vertex, Vertex]]] = {}
    for segment in layers.segments:
        upper, lower = segment.start.vertex, segment.end.vertex
        if segment.turns or upper.cell is not None or lower.cell is not None or segment.uses_lane:
            continue
        if upper.layer > lower.layer:
            upper, lower = lower, upper
        gaps.setdefault(segment.gap, []).append((upper, lower))
    for gap in sorted(gaps):
        pairs = sorted(gaps[gap], key=lambda pair: pair[0].order)
        for at in _longest_increasing([lower.order for _, lower in pairs]):
            upper, lower = pairs[at]
            line = line_of[id(upper)]
            line += line_of[id(lower)]
            line_of[id(lower)] = line
    found: dict[int, list[Vertex]] = {}
    for layer in layers.layers:
        for vertex in layer:
            line = line_of[id(vertex)]
            found[id(line)] = line
    return list(found.values())


def _longest_increasing(numbers: Sequence[int]) -> list[int]:
    """Return the indices of a longest increasing subsequence."""
    ends: list[int] = []
    at_end: list[int] = []
    before: list[int] = []
    for at, number in enumerate(numbers):
        size = bisect_left(ends, number)
        before.append(at_end[size - 1] if size else -1)
        if size == len(ends):
            ends.append(number)
            at_end.append(at)
        else:
            ends[size], at_end[size] = number, at
    found = []
    at = at_end[-1] if at_end else -1
    while at >= 0:
        found.append(at)
        at = before[at]
    return found[::-1]


def _choose_label_sides(
    sides: Sequence[CellSide], layers: Layers, links: Sequence[Link], pitch: int, before: bool
) -> None:
    """Put each label on the side of its line that faces away from other edges."""
    labels = {vertex.link: vertex for layer in layers.layers for vertex in layer if vertex.is_label}
    for side in sides:
        with_label = [
            labels[number]
            for end, number in zip(side.ends, side.links, strict=True)
            if number in labels and links[number].source == end.vertex.cell
        ]
        count = len(with_label)
        for at, vertex in enumerate(with_label):
            if at < count // 2 or (before and count % 2 and at == count // 2):
                vertex.line = vertex.breadth
    for segment in layers.segments:
        for end in (segment.start, segment.end):
            if end.vertex.is_label:
                end.at = end.vertex.line
