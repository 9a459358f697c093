"""Parts of long edges that stay straight.

Of parts that cross, as many as possible are straight: Brandes, Koepf: Fast and Simple Horizontal
Coordinate Assignment (2002), section 4.1. A level in which all of these are straight may be much
broader than its layers: then some of those may bend that make it broad.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from itertools import pairwise

from swarmdsl.tools.diagram.layout.layered_graph import End, Layers, Segment, Vertex
from swarmdsl.tools.diagram.layout.simplex import Constraint

NODE_GAP, LINE_GAP, LABEL_GAP = 26, 12, 12
_PATIENCE = 8
"""Number of rounds after which twice as many parts bend."""
_BROAD = 1.3
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
        for segment in straight:
            upper, lower = upper_and_lower(segment)
            if id(upper.vertex) not in self.number:
                self._add(upper.vertex)
            number = self.number[id(lower.vertex)] = self.number[id(upper.vertex)]
            shift = (upper.at or 0) - (lower.at or 0)
            self.offset[id(lower.vertex)] = self.offset[id(upper.vertex)] + shift
            self._parts[number][segment.gap] = segment
        for layer in layers.layers:
            for vertex in layer:
                if id(vertex) not in self.number:
                    self._add(vertex)
        self.constraints: list[Constraint] = []
        self.places = [0] * len(self._parts)
        # For each number: the one before it that determines its place, if any, in a layer.
        self._before = [(-1, 0)] * len(self._parts)
        self.breadth = self._pack()

    def _add(self, vertex: Vertex) -> None:
        self.number[id(vertex)] = len(self._parts)
        self.offset[id(vertex)] = 0
        self._parts.append({})

    def _pack(self) -> int:
        """Place everything as far to the start as possible; return the breadth."""
        after: list[list[tuple[int, int, int]]] = [[] for _ in self.places]
        waits = [0] * len(self.places)
        for at, layer in enumerate(self.layers.layers):
            for one, other in pairwise(layer):
                room = one.breadth + _gap(one, other) + self.offset[id(one)]
                room -= self.offset[id(other)]
                tail, head = self.number[id(one)], self.number[id(other)]
                self.constraints.append((tail, head, room, 0))
                after[tail].append((head, room, at))
                waits[head] += 1
            if layer:
                first = self.number[id(layer[0])]
                if -self.offset[id(layer[0])] >= self.places[first]:
                    self.places[first] = -self.offset[id(layer[0])]
                    self._before[first] = -1, at
        ready = [number for number, count in enumerate(waits) if not count]
        for number in ready:
            for head, room, at in after[number]:
                if self.places[number] + room > self.places[head]:
                    self.places[head] = self.places[number] + room
                    self._before[head] = number, at
                waits[head] -= 1
                if not waits[head]:
                    ready.append(head)
        assert len(ready) == len(self.places), "straight parts cross"
        return max((self._stop(layer) for layer in self.layers.layers if layer), default=0)

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
            if low < high:
                # The chain is between two others in different layers.
                found.append(self._parts[number][(low + high + 1) // 2])
            number, at = before, left
        return found


def make_chains(layers: Layers) -> Chains:
    """Find parts of edges that stay straight."""
    straight = list(_straight(layers))
    chains = Chains(layers, straight)
    limit = _BROAD * max(map(_least_breadth, layers.layers), default=0)
    # The more rounds, the more parts bend in each, so that large levels need few.
    rounds = 0
    while bent := chains.broader(limit, 1 << rounds // _PATIENCE):
        straight = [segment for segment in straight if segment not in bent]
        chains = Chains(layers, straight)
        rounds += 1
    return chains


def _least_breadth(layer: Sequence[Vertex]) -> int:
    gaps = sum(_gap(one, other) for one, other in pairwise(layer))
    return gaps + sum(vertex.breadth for vertex in layer)


def upper_and_lower(segment: Segment) -> tuple[End, End]:
    """Return the ends of a segment in the order of layers."""
    if segment.start.side == "first":
        return segment.end, segment.start
    return segment.start, segment.end


def takes_space(vertex: Vertex) -> bool:
    """Return True for a cell that takes space, False for a continuation at the border."""
    return vertex.cell is not None and vertex.breadth > 0


def _gap(one: Vertex, other: Vertex) -> int:
    nodes = takes_space(one) + takes_space(other)
    if nodes == 2:
        return NODE_GAP
    return LABEL_GAP if nodes or one.is_label or other.is_label else LINE_GAP


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
