"""Assign coordinates across to vertices and edge ends.

Inner segments of a link form one straight line wherever possible. The coordinates of lines and
cells minimize the weighted bends of edges: Gansner et al. 1993, section 4, with one number for the
inner segments of a link, as in Sander: Layout of Compound Directed Graphs (1996), section 6.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from heapq import heappop, heappush, heapreplace
from itertools import accumulate, pairwise

from swarmdsl.tools.diagram.layout.layered_graph import Cell, End, Layers, Link, Segment, Vertex
from swarmdsl.tools.diagram.layout.simplex import Constraint, minimize

NODE_GAP, LINE_GAP, LABEL_GAP = 26, 12, 14
END_GAP = 12
"""Preferred distance between two ends on one side of a cell."""
_CORNER = 7
_NARROW = 20
"""Width below which moving ends does not help."""


def assign_coordinates(
    layers: Layers, cells: Sequence[Cell], links: Sequence[Link], pitch: int, before: bool
) -> None:
    """Set the positions of vertices and ends across.

    `before` selects the side for the label of a single edge, or of the middle one.
    """
    sides = _sides(layers, cells)
    _choose_label_sides(sides, layers, links, pitch, before)
    for ends in sides:
        ends.spread()
    lines = _lines(layers)
    fixed = {id(end) for side in sides for end in side.fixed()}
    _minimize(layers, lines, fixed)
    _place_lanes(layers)
    for _ in range(2):
        # The second pass follows ends on other cells that moved in the first.
        for ends in sides:
            ends.slide()


def _minimize(layers: Layers, lines: Sequence[Sequence[Vertex]], fixed: set[int]) -> None:
    """Place all lines so that edges are as straight as possible, starting at 0."""
    number = {id(vertex): at for at, line in enumerate(lines) for vertex in line}
    constraints: list[Constraint] = []
    for layer in layers.layers:
        for one, other in pairwise(layer):
            room = one.breadth - one.line + other.line + _gap(one, other)
            constraints.append((number[id(one)], number[id(other)], room, 0))
    count = len(lines)
    for segment in layers.segments:
        start, end = segment.start, segment.end
        if segment.uses_lane:
            continue
        if number[id(start.vertex)] == number[id(end.vertex)]:
            continue
        offset = _offset(end) - _offset(start)
        weight = _weight(segment, fixed)
        constraints.append((count, number[id(start.vertex)], max(0, offset), weight))
        constraints.append((count, number[id(end.vertex)], max(0, -offset), weight))
        count += 1
    places = minimize(count, constraints)
    for at, line in enumerate(lines):
        for vertex in line:
            vertex.across = places[at] - vertex.line
    least = min((v.across for layer in layers.layers for v in layer), default=0)
    for layer in layers.layers:
        for vertex in layer:
            vertex.across -= least


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


def _weight(segment: Segment, fixed: set[int]) -> int:
    """Cost per pixel of bend in a segment.

    Lower at a cell whose end can still move, lowest at the target of the link: a necessary bend is
    a single one, away from the label.
    """
    if segment.turns:
        return 1  # it always bends
    start, end = _takes_space(segment.start.vertex), _takes_space(segment.end.vertex)
    if start and end:
        return 12
    if not (start or end):
        return 32
    if id(segment.start if start else segment.end) in fixed:
        return 12
    return 9 if start else 8


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
    sides: Sequence[_CellSide], layers: Layers, links: Sequence[Link], pitch: int, before: bool
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


class _CellSide:
    """Ends of links on one side of a cell, in order, with their possible positions."""

    def __init__(self, cell: Cell, found: Sequence[tuple[End, End, int]]) -> None:
        fixed = [each for each in found if each[0].at is not None]
        fixed.sort(key=lambda each: each[0].at or 0)
        free = [each for each in found if each[0].at is None]
        free.sort(key=lambda each: _order(each[1]))
        merged = list(fixed)
        orders = sorted(_order(other) for _, other, _ in fixed)
        for number, each in enumerate(free):
            # Insert it between fixed ends so that it crosses none.
            merged.insert(bisect_left(orders, _order(each[1])) + number, each)
        self.ends = [end for end, _, _ in merged]
        self.others = [other for _, other, _ in merged]
        self.links = [link for _, _, link in merged]
        self.movable = [end.at is None for end in self.ends]
        self.cell = cell

    def fixed(self) -> list[End]:
        """Return the ends that cannot move."""
        narrow = self.cell.high - self.cell.low < _NARROW
        return [
            end for end, moves in zip(self.ends, self.movable, strict=True) if narrow or not moves
        ]

    def runs(self) -> list[tuple[range, int, int]]:
        """Ranges of adjacent movable ends, with their lower and upper bounds."""
        low, high = self.cell.low, self.cell.high
        found = []
        start = 0
        bottom = low
        for at in range(len(self.ends) + 1):
            if at < len(self.ends) and self.movable[at]:
                continue
            top = high if at == len(self.ends) else (self.ends[at].at or 0)
            if start < at:
                found.append((range(start, at), bottom, max(top, bottom)))
            start = at + 1
            bottom = max(top, bottom)
        return found

    def spread(self) -> None:
        """Space the ends evenly."""
        for run, bottom, top in self.runs():
            for number, at in enumerate(run, 1):
                self.ends[at].at = bottom + (top - bottom) * number // (len(run) + 1)

    def slide(self) -> None:
        """Move the ends so that their edges are straight, within the available space."""
        across = self.ends[0].vertex.across if self.ends else 0
        for run, bottom, top in self.runs():
            room = top - bottom
            gap = min(END_GAP, room // (len(run) + 1))
            corner = min(_CORNER, room // (len(run) + 1))
            low, high = bottom + corner, top - corner - gap * (len(run) - 1)
            wished = [
                min(max(self.others[at].across - across - gap * number, low), high)
                for number, at in enumerate(run)
            ]
            for number, (at, value) in enumerate(zip(run, monotone(wished), strict=True)):
                self.ends[at].at = value + gap * number


def _order(end: End) -> tuple[int, int]:
    return end.vertex.order, end.at or 0


def monotone(values: Sequence[int]) -> list[int]:
    """Return the closest non-decreasing numbers.

    Each is the least of the highest values so far, after a value that is less than those before has
    pulled the highest down to itself.
    """
    heap: list[int] = []  # negative values, highest first
    found = []
    for value in values:
        heappush(heap, -value)
        if -heap[0] > value:
            heapreplace(heap, -value)
        found.append(-heap[0])
    return list(accumulate(reversed(found), min))[::-1]


def _sides(layers: Layers, cells: Sequence[Cell]) -> list[_CellSide]:
    """Return the ends of links for each side of each cell."""
    found: dict[tuple[int, str], list[tuple[End, End, int]]] = {}
    for segment in layers.segments:
        for end, other in ((segment.start, segment.end), (segment.end, segment.start)):
            if end.vertex.cell is not None:
                key = (end.vertex.cell, end.side)
                found.setdefault(key, []).append((end, other, segment.link))
    return [_CellSide(cells[cell], ends) for (cell, _), ends in found.items()]
