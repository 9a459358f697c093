"""Parts of long edges that stay straight.

Of parts that cross, as many as possible are straight: Brandes, Koepf: Fast and Simple Horizontal
Coordinate Assignment (2002), section 4.1. A level in which all of these are straight may be much
broader than its layers: then some of those may bend that make it broad.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence

from swarmdsl.tools.diagram.layout.layered_graph import End, Layers, Segment, Vertex
from swarmdsl.tools.diagram.layout.simplex import Constraint

NODE_GAP, LINE_GAP, LABEL_GAP = 26, 12, 12
_PATIENCE = 4
"""Number of rounds after which twice as many parts bend."""
_BROAD = 1.2
"""Breadth of a level, relative to its broadest layer, above which straight parts may bend."""


class Chains:
    """Numbers of the vertices of a level: the same one along a chain of straight parts.

    A vertex is at the position of its number, plus its `offset`. `places` are small positions with
    the distances in layers, which are `constraints`, and `breadth` is their extent.
    """

    def __init__(self, layers: Layers, straight: Sequence[Segment]) -> None:
        self.layers = layers
        self.number: dict[int, int] = {}
        self.offset: dict[int, int] = {}
        self._parts: list[dict[int, Segment]] = []
        number, offset = self.number, self.offset
        for segment in straight:
            upper, lower = upper_and_lower(segment)
            above, below = id(upper.vertex), id(lower.vertex)
            if above not in number:
                number[above], offset[above] = len(self._parts), 0
                self._parts.append({})
            number[below] = number[above]
            offset[below] = offset[above] + (upper.at or 0) - (lower.at or 0)
            self._parts[number[above]][segment.gap] = segment
        for layer in layers.layers:
            for vertex in layer:
                if id(vertex) not in number:
                    number[id(vertex)], offset[id(vertex)] = len(self._parts), 0
                    self._parts.append({})
        self.constraints: list[Constraint] = []
        self.places = [0] * len(self._parts)
        # For each number: the one before it that determines its place, if any, in a layer.
        self._before = [(-1, 0)] * len(self._parts)
        self.after: list[list[tuple[int, int, int]]] = [[] for _ in self._parts]
        self.order = self._pack()
        self.breadth = max((self._stop(layer) for layer in layers.layers if layer), default=0)

    def _pack(self) -> list[int]:
        """Place everything as far to the start as possible; return the order of the numbers."""
        number, offset, places, after = self.number, self.offset, self.places, self.after
        waits = [0] * len(places)
        for at, layer in enumerate(self.layers.layers):
            if not layer:
                continue
            one = layer[0]
            tail = number[id(one)]
            if -offset[id(one)] >= places[tail]:
                places[tail] = -offset[id(one)]
                self._before[tail] = -1, at
            for other in layer[1:]:
                head = number[id(other)]
                room = one.breadth + _gap(one, other) + offset[id(one)] - offset[id(other)]
                self.constraints.append((tail, head, room, 0))
                after[tail].append((head, room, at))
                waits[head] += 1
                one, tail = other, head
        order = [each for each, count in enumerate(waits) if not count]
        for tail in order:
            place = places[tail]
            for head, room, at in after[tail]:
                if place + room > places[head]:
                    places[head] = place + room
                    self._before[head] = tail, at
                waits[head] -= 1
                if not waits[head]:
                    order.append(head)
        assert len(order) == len(places), "straight parts cross"
        return order

    def _stop(self, layer: Sequence[Vertex]) -> int:
        last = layer[-1]
        return self.places[self.number[id(last)]] + self.offset[id(last)] + last.breadth

    def broader(self, limit: float, count: int) -> set[Segment]:
        """Return straight parts of which each keeps a layer from having this breadth.

        At most `count` of a layer.
        """
        found: set[Segment] = set()
        for at, layer in enumerate(self.layers.layers):
            if layer and self._stop(layer) > limit and (parts := self._before_end(at)):
                step = len(parts) / min(count, len(parts))
                found.update(
                    parts[int(step * (number + 0.5))] for number in range(min(count, len(parts)))
                )
        return found

    def _before_end(self, at: int) -> list[Segment]:
        """Parts between the vertices that determine where a layer ends, from there to the start."""
        number = self.number[id(self.layers.layers[at][-1])]
        found = []
        while number >= 0:
            before, left = self._before[number]
            low, high = min(at, left), max(at, left)
            if low < high and not (part := self._parts[number][(low + high + 1) // 2]).fixed:
                # The chain is between two others in different layers.
                found.append(part)
            number, at = before, left
        return found


def make_chains(layers: Layers) -> Chains:
    """Find parts of edges that stay straight."""
    straight = list(_straight(layers))
    chains = Chains(layers, straight)
    limit = _BROAD * Chains(layers, [segment for segment in straight if segment.fixed]).breadth
    # The more rounds, the more parts bend in each, so that large levels need few.
    rounds = 0
    while bent := chains.broader(limit, 1 << rounds // _PATIENCE):
        straight = [segment for segment in straight if segment not in bent]
        chains = Chains(layers, straight)
        rounds += 1
    return chains


def upper_and_lower(segment: Segment) -> tuple[End, End]:
    """Return the ends of a segment in the order of layers."""
    if segment.start.side == "first":
        return segment.end, segment.start
    return segment.start, segment.end


def takes_space(vertex: Vertex) -> bool:
    """Return True for a cell that takes space, False for a continuation at the border."""
    return vertex.cell is not None and vertex.breadth > 0


def _gap(one: Vertex, other: Vertex) -> int:
    if not (one.breadth or other.breadth):
        return LINE_GAP
    if takes_space(one) and takes_space(other):
        return NODE_GAP
    return LABEL_GAP


def _straight(layers: Layers) -> Iterator[Segment]:
    """Yield parts of edges between layers that can all be straight, from the top down."""
    inner: list[list[tuple[int, int, Segment]]] = [[] for _ in layers.layers]
    for segment in layers.segments:
        if not (segment.turns or segment.uses_lane):
            upper, lower = upper_and_lower(segment)
            if not (takes_space(upper.vertex) or takes_space(lower.vertex)):
                inner[segment.gap].append((upper.vertex.order, lower.vertex.order, segment))
    for parts in inner:
        parts.sort(key=lambda part: part[:2])
        yield from (parts[at][2] for at in _longest_rise([part[1] for part in parts]))


def _longest_rise(values: Sequence[int]) -> list[int]:
    """Return the indices of a longest increasing part of a sequence."""
    tops: list[int] = []
    ends: list[int] = []
    before: list[int] = []
    for at, value in enumerate(values):
        length = bisect_left(tops, value)
        before.append(ends[length - 1] if length else -1)
        tops[length : length + 1] = [value]
        ends[length : length + 1] = [at]
    found = []
    at = ends[-1] if ends else -1
    while at >= 0:
        found.append(at)
        at = before[at]
    return found[::-1]
