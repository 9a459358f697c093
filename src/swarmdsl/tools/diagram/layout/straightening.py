"""Coordinates across that make edges straight.

A network of differences has a number for each vertex, and one for each end of an edge that can
move on its cell; vertices between which an edge stays straight share one. The weighted bends of
edges are minimal: Gansner et al. 1993, section 4. Two more numbers are the bounds of the level.
Their distance has a cost, so that a level is narrower where that needs few bends.
"""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.tools.diagram.layout.cell_sides import CellSide
from swarmdsl.tools.diagram.layout.chains import make_chains, takes_space
from swarmdsl.tools.diagram.layout.layered_graph import End, Layers, Segment
from swarmdsl.tools.diagram.layout.simplex import minimize

_NARROW = 8
"""Cost of the breadth of a level, per pixel; half the number of vertices in a row is added."""


class Straightener:
    """Network of the positions of a level, with positions that satisfy it."""

    def __init__(self, layers: Layers, sides: Sequence[CellSide]) -> None:
        self.layers = layers
        self.sides = sides
        self.chains = make_chains(layers)
        self.constraints = self.chains.constraints
        self.places = self.chains.places
        self.end_number: dict[int, int] = {}

    def place(self) -> None:
        """Set the positions of vertices and of movable ends, starting at 0."""
        self._add_bounds()
        for side in self.sides:
            self._add_ends(side)
        for segment in self.layers.segments:
            if not segment.uses_lane:
                (one, at), (other, to) = self._end(segment.start), self._end(segment.end)
                self._add_cost(one, other, at - to, _weight(segment))
        for side in self.sides:
            for end in side.ends:
                if id(end) in self.end_number:
                    # A slight preference for ends that are spread evenly.
                    assert end.at is not None
                    cell = self.chains.number[id(end.vertex)]
                    self._add_cost(cell, self.end_number[id(end)], end.at, 1)
        found = minimize(len(self.places), self.constraints, self.places)
        vertices = [vertex for layer in self.layers.layers for vertex in layer]
        for vertex in vertices:
            vertex.across = found[self.chains.number[id(vertex)]] + self.chains.offset[id(vertex)]
        least = min((vertex.across for vertex in vertices), default=0)
        for vertex in vertices:
            vertex.across -= least
        for side in self.sides:
            for end in side.ends:
                if id(end) in self.end_number:
                    end.at = found[self.end_number[id(end)]] - least - end.vertex.across

    def _add_bounds(self) -> None:
        number, offset = self.chains.number, self.chains.offset
        top = len(self.places)
        bottom = top + 1
        for layer in filter(None, self.layers.layers):
            first, last = layer[0], layer[-1]
            self.constraints.append((top, number[id(first)], -offset[id(first)], 0))
            room = offset[id(last)] + last.breadth
            self.constraints.append((number[id(last)], bottom, room, 0))
        count = sum(map(len, self.layers.layers)) // self.layers.rows
        self.constraints.append((top, bottom, 0, _NARROW + count // 2))
        self.places += (0, self.chains.breadth)

    def _add_ends(self, side: CellSide) -> None:
        """Add the ends of a side that can move, in order and between their bounds."""
        for run, low, high, gap in side.runs:
            cell = self.chains.number[id(side.ends[run[0]].vertex)]
            before, distance = cell, low
            for at in run:
                end = side.ends[at]
                assert end.at is not None
                number = self.end_number[id(end)] = len(self.places)
                self.places.append(self.places[cell] + end.at)
                self.constraints.append((before, number, distance, 0))
                before, distance = number, gap
            self.constraints.append((before, cell, -high, 0))

    def _end(self, end: End) -> tuple[int, int]:
        """Return the number that an end depends on, and its distance from that."""
        if id(end) in self.end_number:
            return self.end_number[id(end)], 0
        assert end.at is not None
        return self.chains.number[id(end.vertex)], end.at + self.chains.offset[id(end.vertex)]

    def _add_cost(self, one: int, other: int, distance: int, weight: int) -> None:
        """Add the cost of a distance from `one` to `other` other than this."""
        if one == other:
            return
        to_one, to_other = max(0, -distance), max(0, distance)
        # A further number is below both, as near as they let it be.
        below = len(self.places)
        self.constraints.append((below, one, to_one, weight))
        self.constraints.append((below, other, to_other, weight))
        self.places.append(min(self.places[one] - to_one, self.places[other] - to_other))


def _weight(segment: Segment) -> int:
    """Cost per pixel of bend in a segment.

    Lower at a cell, lowest at the target of the link: a necessary bend is a single one, away from
    the label.
    """
    if segment.turns:
        return 1  # it always bends
    start, end = takes_space(segment.start.vertex), takes_space(segment.end.vertex)
    if start and end:
        return 24
    if not (start or end):
        return 64
    return 20 if start else 18
