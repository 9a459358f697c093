"""Wrap the layers of a long level into rows.

A row is a part of the layers; rows are side by side across. An edge between two rows goes around
the end of the upper one, back along a lane beside it, and around the start of the lower one. One to
a row farther away goes on there, past the rows between. Rueegg, von Hanxleden: Wrapping Layered
Graphs, Diagrams 2018.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from heapq import nsmallest
from itertools import groupby, pairwise, zip_longest

from swarmdsl.tools.diagram.layout.chains import upper_and_lower
from swarmdsl.tools.diagram.layout.layered_graph import End, Layers, Segment, Vertex

LANE_COST = 40
"""Difference in length of two rows that counts like an edge between them."""
MAX_LANES = 20
"""Number of edges between two rows at most."""
_CHOICES = 4
"""Number of places for the start of a row for which the lengths of its layers are compared."""
_GAP = 40
"""Approximate space between two layers."""


def starts_of_rows(lengths: Sequence[int], crossed: Sequence[int], rows: int) -> list[int]:
    """Return the layers with which rows begin, for layers of these lengths.

    `crossed` are the numbers of edges before each layer. The rows have similar lengths and few
    edges between them, and long layers beside long ones; there are fewer if there are no such.
    """
    ends = [0]
    for length in lengths:
        ends.append(ends[-1] + length)
    row = ends[-1] / rows
    starts = [0]
    beside: list[int] = []
    for number in range(1, rows):
        first = bisect_left(ends, row * (number - 0.5))
        last = bisect_left(ends, row * (number + 0.5))
        choices = [
            (abs(ends[at] - row * number) + LANE_COST * crossed[at], at)
            for at in range(max(first, starts[-1] + 1), min(last, len(lengths)))
            if crossed[at] <= MAX_LANES
        ]
        if not choices:
            continue
        likely = nsmallest(_CHOICES, choices)
        beside = lay_beside(beside, lengths[starts[-1] : likely[0][1]])
        longer = [
            cost + sum(lay_beside(beside, lengths[at : at + len(beside)])) for cost, at in likely
        ]
        starts.append(likely[longer.index(min(longer))][1])
    return starts


def lay_beside(lengths: Sequence[int], row: Sequence[int]) -> list[int]:
    """Return the lengths of layers that a further row shares."""
    return [max(pair) for pair in zip_longest(lengths, row, fillvalue=0)]


def wrap(graph: Layers, rows: int) -> None:
    """Wrap ordered layers into at most this number of rows."""
    lengths = [max((vertex.length for vertex in layer), default=0) for layer in graph.layers]
    crossed = [0] * (len(graph.layers) + 1)
    for segment in graph.segments:
        ends = (segment.start.vertex, segment.end.vertex)
        # A label is rather in the row of its source.
        begins = any(end.is_label for end in ends) and any(end.cell is not None for end in ends)
        crossed[segment.gap] += 1 + begins
    starts = starts_of_rows([length + _GAP for length in lengths], crossed, rows)
    if len(starts) > 1 and not graph.lanes:
        _Wrapping(graph, starts).apply()


class _Wrapping:
    """Rows of a graph that begin with some of its layers, and the lanes between them."""

    def __init__(self, graph: Layers, starts: Sequence[int]) -> None:
        self.graph = graph
        self.starts = starts
        bounds = [*starts, len(graph.layers)]
        self.heights = [stop - start for start, stop in pairwise(bounds)]
        self.row_of = [row for row, height in enumerate(self.heights) for _ in range(height)]
        # For each row: the ends from which lanes lead to the next ones, with the lanes.
        self.lanes: list[list[tuple[End, list[Vertex]]]] = [[] for _ in starts]

    def apply(self) -> None:
        """Put the rows beside each other into the graph."""
        segments: list[Segment] = []
        for _, part in groupby(self.graph.segments, key=lambda segment: segment.link):
            segments += self._wrapped(list(part))
        kept = {segment.start.vertex for segment in segments}
        kept.update(segment.end.vertex for segment in segments)
        kept.update(self.graph.cells)
        layers: list[list[Vertex]] = [[] for _ in range(max(self.heights))]
        for row, start in enumerate(self.starts):
            for at in range(self.heights[row]):
                layers[at] += (each for each in self.graph.layers[start + at] if each in kept)
            # From the inside out: the last edge of the row takes the first lane.
            lanes = sorted(self.lanes[row], key=lambda lane: _place(lane[0]), reverse=True)
            for _, lane in lanes:
                for at, vertex in enumerate(lane):
                    layers[at].append(vertex)
        for at, layer in enumerate(layers):
            for place, vertex in enumerate(layer):
                vertex.layer, vertex.order = at, place
        self.graph.layers, self.graph.segments = layers, segments

    def _wrapped(self, segments: Sequence[Segment]) -> list[Segment]:
        """Segments of a link, with lanes in place of the rows between its ends."""
        link = segments[0].link
        pairs = [upper_and_lower(segment) for segment in segments]
        downwards = segments[0].start is pairs[0][0]
        if not downwards:
            pairs.reverse()
        low, high = self._row(pairs[0][0]), self._row(pairs[-1][1])
        found = [
            Segment(self._gap(lower), link, upper, lower)
            for upper, lower in pairs
            if self._row(upper) == self._row(lower) == low
        ]
        if low < high:
            leaving = next(upper for upper, lower in pairs if self._row(lower) > low)
            entering = next(lower for _, lower in pairs if self._row(lower) == high)
            found += self._lane(link, low, leaving, entering)
            found += (
                Segment(self._gap(lower), link, upper, lower)
                for upper, lower in pairs
                if self._row(upper) == self._row(lower) == high
            )
            self._move_label(pairs, found, downwards)
        if downwards:
            return found
        return [
            Segment(each.gap, link, each.end, each.start, each.fixed) for each in reversed(found)
        ]

    def _lane(self, link: int, row: int, leaving: End, entering: End) -> list[Segment]:
        """Segments on a new lane after a row."""
        lane = [Vertex(0, 0, at, link=link) for at in range(self.heights[row])]
        self.lanes[row].append((leaving, lane))
        last = End(lane[-1], "last", 0)
        found = [Segment(len(lane), link, leaving, last)]
        for upper, lower in pairwise(reversed(lane)):
            ends = End(upper, "first", 0), End(lower, "last", 0)
            found.append(Segment(upper.layer, link, *ends, fixed=True))
        found.append(Segment(0, link, End(lane[0], "first", 0), entering))
        return found

    def _move_label(
        self, pairs: Sequence[tuple[End, End]], found: Sequence[Segment], downwards: bool
    ) -> None:
        """Put the label of a link on the lane if it would be in another row than the source."""
        source = pairs[0][0] if downwards else pairs[-1][1]
        label = next((upper.vertex for upper, _ in pairs if upper.vertex.is_label), None)
        if label is None or self._row(source) == self.row_of[label.layer]:
            return
        turns = [segment for segment in found if segment.turns]
        lane = turns[0].end.vertex if downwards else turns[-1].start.vertex
        lane.length, lane.breadth, lane.is_label = label.length, label.breadth, True
        label.length, label.breadth, label.is_label = 0, 0, False

    def _row(self, end: End) -> int:
        return self.row_of[end.vertex.layer]

    def _gap(self, lower: End) -> int:
        """Return the number of the gap before a vertex in its row."""
        return lower.vertex.layer - self.starts[self._row(lower)]


def _place(end: End) -> tuple[int, int]:
    return end.vertex.order, end.at or 0
