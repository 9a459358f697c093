"""Coordinates across that make edges straight.

A network of differences has a number for each vertex, and one for each end of an edge that can
move on its cell; vertices between which an edge stays straight share one. The weighted bends of
edges are minimal: Gansner et al. 1993, section 4. Two more numbers are the bounds of the level.
Their distance has a cost, so that a level is narrower where that needs few bends. At last, short
bends are removed where nothing but breadth and longer bends is in the way.
"""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.tools.diagram.layout.cell_sides import CellSide
from swarmdsl.tools.diagram.layout.chains import make_chains, takes_space
from swarmdsl.tools.diagram.layout.layered_graph import End, Layers, Segment
from swarmdsl.tools.diagram.layout.relaxation import relax
from swarmdsl.tools.diagram.layout.simplex import Network

_NARROW = 8
"""Cost of the breadth of a level, per pixel; half the number of vertices is added."""
_LONG, _SHARE = 1_000, 8
"""Length from which on a level leaves large areas empty, and its share that is added then."""
_GAP = 40
"""Approximate space between two layers."""

_SHORT, _SHORT_COST = 14, 10_000
"""Extent below which a bend looks like a mistake, and its cost then."""


class Straightener:
    """Network of the positions of a level, with positions that satisfy it."""

    def __init__(self, layers: Layers, sides: Sequence[CellSide]) -> None:
        self.layers = layers
        self.sides = sides
        self.chains = make_chains(layers)
        self.constraints = self.chains.constraints
        self.places = self.chains.places
        self.end_number: dict[int, int] = {}
        # For each segment: two numbers, the distance at which it is straight, and its constraint.
        self.bends: list[tuple[int, int, int, int]] = []

    def place(self) -> None:
        """Set the positions of vertices and of movable ends, starting at 0."""
        self._relax()
        self._add_bounds()
        for side in self.sides:
            self._add_ends(side)
        for segment in self.layers.segments:
            if not segment.uses_lane:
                (one, at), (other, to) = self._end(segment.start), self._end(segment.end)
                if one == other:
                    continue
                if not segment.turns:
                    self.bends.append((one, other, at - to, len(self.constraints)))
                self._add_cost(one, other, at - to, _weight(segment))
        for side in self.sides:
            for end in side.ends:
                if id(end) in self.end_number:
                    # A slight preference for ends that are spread evenly.
                    assert end.at is not None
                    cell = self.chains.number[id(end.vertex)]
                    self._add_cost(cell, self.end_number[id(end)], end.at, 1)
        network = Network(len(self.places), self.constraints, self.places)
        network.solve()
        self._remove_short_bends(network)
        network.balance()
        found = network.numbers()
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

    def _remove_short_bends(self, network: Network) -> None:
        """Straighten segments with short bends, whatever breadth or long bends that costs."""
        found = network.numbers()
        near = [each for each in self.bends if abs(_bend(each, found)) < _SHORT]
        if any(_bend(each, found) for each in near):
            for *_, number in near:
                network.weight[number] = network.weight[number + 1] = _SHORT_COST
            network.solve()

    def _relax(self) -> None:
        """Begin with places near to those of neighbors."""
        pulls = []
        number, offset = self.chains.number, self.chains.offset
        for segment in self.layers.segments:
            if not (segment.turns or segment.uses_lane):
                one, other = segment.start, segment.end
                distance = offset[id(one.vertex)] + (one.at or 0)
                distance -= offset[id(other.vertex)] + (other.at or 0)
                ends = number[id(one.vertex)], number[id(other.vertex)]
                if ends[0] != ends[1]:
                    pulls.append((*ends, distance, _weight(segment)))
        self.places[:] = relax(self.places, self.chains.order, self.chains.after, pulls)

    def _add_bounds(self) -> None:
        number, offset = self.chains.number, self.chains.offset
        top = len(self.places)
        bottom = top + 1
        start, stop = min(self.places, default=0), max(self.places, default=0)
        for layer in filter(None, self.layers.layers):
            first, last = layer[0], layer[-1]
            self.constraints.append((top, number[id(first)], -offset[id(first)], 0))
            room = offset[id(last)] + last.breadth
            self.constraints.append((number[id(last)], bottom, room, 0))
            start = min(start, self.places[number[id(first)]] + offset[id(first)])
            stop = max(stop, self.places[number[id(last)]] + room)
        cost = _NARROW + sum(map(len, self.layers.layers)) // 2
        lengths = (max((each.length for each in layer), default=0) for layer in self.layers.layers)
        cost += max(0, sum(lengths) + _GAP * len(self.layers.layers) - _LONG) // _SHARE
        self.constraints.append((top, bottom, 0, cost))
        self.places += (start, stop)

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
        to_one, to_other = max(0, -distance), max(0, distance)
        # A further number is below both, as near as they let it be.
        below = len(self.places)
        self.constraints.append((below, one, to_one, weight))
        self.constraints.append((below, other, to_other, weight))
        self.places.append(min(self.places[one] - to_one, self.places[other] - to_other))


def _bend(segment: tuple[int, int, int, int], found: Sequence[int]) -> int:
    one, other, distance, _ = segment
    return found[one] + distance - found[other]


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
