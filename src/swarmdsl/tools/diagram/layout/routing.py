"""Route edges with right angles between layers, and assign coordinates along.

Each part of an edge that runs across gets a track; parts that would overlap get different ones. The
order of tracks keeps crossings few (Sander: Layout of Directed Hypergraphs with Orthogonal
Hyperedges, 2004; with a greedy order as in Eades, Lin, Smyth 1993).
"""

from __future__ import annotations

from collections.abc import Sequence
from heapq import heappop, heappush

from swarmdsl.base.records import dataclass
from swarmdsl.tools.diagram.layout.label_places import LABEL_MARGIN, place_labels
from swarmdsl.tools.diagram.layout.layered_graph import (
    Cell,
    LayerPositions,
    Layers,
    Link,
    Placement,
    Point,
    Segment,
)

TRACK = 10
"""Distance between adjacent parallel lines."""
_MARGIN = 16
"""Distance between a line and a node, with space for an arrow head."""
_NEAR = 6
"""Lines closer than this look like one."""
_MAX_ORDERED = 80
_OVERLAP_COST = 1000
_ROUNDS = 4
"""Number of times at most that each part is moved to a better place among the others."""


@dataclass
class _Crossbar:
    """Part of a segment that runs across, from `low` to `high`, on a track.

    `ups` and `downs` are the positions of its connections to the layer before and after.
    """

    segment: Segment
    low: int
    high: int
    ups: list[int]
    downs: list[int]
    track: int = 0


def route(
    layers: Layers, cells: Sequence[Cell], links: Sequence[Link], pitch: int, in_row: bool
) -> Placement:
    """Assign coordinates along to layers and route the links.

    With `in_row`, the cells of a layer are aligned at their start, otherwise at their center.
    """
    count = len(layers.layers)
    bars: list[list[_Crossbar]] = [[] for _ in range(count + 1)]
    for segment in layers.segments:
        if (bar := _crossbar(segment)) is not None:
            bars[segment.gap].append(bar)
    starts, lengths = [], []
    along = 0
    firsts = []
    for gap in range(count + 1):
        tracks = _assign_tracks(bars[gap])
        before, after = _margins(layers, gap)
        room = before + after + max(0, tracks - 1) * TRACK
        if gap in (0, count):
            room = (_MARGIN + (tracks - 1) * TRACK) if tracks else 0
            before = _MARGIN if gap == count else 0
        firsts.append(along + before)
        along += room
        if gap < count:
            length = max((vertex.length for vertex in layers.layers[gap]), default=0)
            starts.append(along)
            lengths.append(length)
            along += length
    placed = LayerPositions(starts, lengths, along, in_row)
    tracks_of = {
        id(bar.segment): firsts[gap] + bar.track * TRACK
        for gap in range(count + 1)
        for bar in bars[gap]
    }
    routes = _routes(layers, cells, links, placed, tracks_of)
    breadth = max(
        (
            *(vertex.across + vertex.breadth for layer in layers.layers for vertex in layer),
            *(point[1] for way in routes for point in way),
        ),
        default=0,
    )
    return Placement(
        along,
        breadth,
        [(placed.cell(cells[v.cell or 0], v.layer, v.length), v.across) for v in layers.cells],
        routes,
        place_labels(layers, cells, links, placed, pitch),
    )


def _crossbar(segment: Segment) -> _Crossbar | None:
    """Part of a segment that runs across; None if the segment is straight."""
    start, end = segment.start.across, segment.end.across
    if start == end and not segment.turns:
        return None
    bar = _Crossbar(segment, min(start, end), max(start, end), [], [])
    for point in (segment.start, segment.end):
        (bar.ups if point.side == "last" else bar.downs).append(point.across)
    return bar


def _margins(layers: Layers, gap: int) -> tuple[int, int]:
    """Space before and after the tracks of a gap, with room for arrows beside cells."""

    def margin(layer: int) -> int:
        if not 0 <= layer < len(layers.layers):
            return 0
        inner = [vertex for vertex in layers.layers[layer] if vertex.length]
        return _MARGIN if any(vertex.cell is not None for vertex in inner) else LABEL_MARGIN

    return margin(gap - 1), margin(gap)


def _assign_tracks(bars: list[_Crossbar]) -> int:
    """Assign a track to each bar and return the number of tracks."""
    if not bars:
        return 0
    bars.sort(key=lambda bar: (bar.low, bar.high))
    if len(bars) <= _MAX_ORDERED:
        _assign_with_few_crossings(bars)
    else:
        _assign_in_order(bars)
    return max(bar.track for bar in bars) + 1


def _assign_with_few_crossings(bars: Sequence[_Crossbar]) -> None:
    """Compare each bar with each other one that it meets."""
    before: list[list[int]] = [[] for _ in bars]
    weight: list[dict[int, int]] = [{} for _ in bars]
    for at, one in enumerate(bars):
        for number in range(at + 1, len(bars)):
            other = bars[number]
            if other.low > one.high + _NEAR:
                break
            first, second = _cost(one, other), _cost(other, one)
            before[at].append(number)
            before[number].append(at)
            if first != second:
                weight[at][number] = second - first
                weight[number][at] = first - second
    order = _greedy_order(weight)
    _insert_better(order, weight)
    place = [0] * len(bars)
    for number, at in enumerate(order):
        place[at] = number
    for at in order:
        tracks = [bars[each].track + 1 for each in before[at] if place[each] < place[at]]
        bars[at].track = max(tracks, default=0)


def _assign_in_order(bars: Sequence[_Crossbar]) -> None:
    """Put each bar on the track after the last one that a bar before it has there."""
    met: list[tuple[int, int]] = []  # heap of (-track, high)
    for bar in bars:
        # The bars are sorted: none of the others meets one that ends before this one.
        while met and met[0][1] + _NEAR < bar.low:
            heappop(met)
        bar.track = 1 - met[0][0] if met else 0
        heappush(met, (-bar.track, bar.high))


def _cost(one: _Crossbar, other: _Crossbar) -> int:
    """Count crossings and weighted overlaps if `one` is on a track before `other`."""
    cost = sum(other.low < down < other.high for down in one.downs)
    cost += sum(one.low < up < one.high for up in other.ups)
    near = sum(abs(down - up) < _NEAR for down in one.downs for up in other.ups)
    return cost + _OVERLAP_COST * near


def _greedy_order(weight: Sequence[dict[int, int]]) -> list[int]:
    """Order of the bars; next is always the one with the highest gain over the rest."""
    gain = [sum(each.values()) for each in weight]
    left = set(range(len(weight)))
    found = []
    while left:
        best = max(left, key=lambda at: (gain[at], -at))
        left.remove(best)
        found.append(best)
        for other, value in weight[best].items():
            gain[other] += value
    return found


def _insert_better(order: list[int], weight: Sequence[dict[int, int]]) -> None:
    """Move each bar to the place where it costs least, as long as that helps."""
    for _ in range(_ROUNDS):
        better = False
        for bar in list(order):
            if not (mine := weight[bar]):
                continue
            at = order.index(bar)
            best, least, cost = at, 0, 0
            for place in range(at + 1, len(order)):
                cost += mine.get(order[place], 0)
                if cost < least:
                    best, least = place, cost
            cost = 0
            for place in range(at - 1, -1, -1):
                cost -= mine.get(order[place], 0)
                if cost < least:
                    best, least = place, cost
            if best != at:
                order.insert(best, order.pop(at))
                better = True
        if not better:
            return


def _routes(
    layers: Layers,
    cells: Sequence[Cell],
    links: Sequence[Link],
    placed: LayerPositions,
    tracks_of: dict[int, int],
) -> list[list[Point]]:
    """Points of each link from source to target."""
    routes: list[list[Point]] = [[] for _ in links]
    for segment in layers.segments:
        path = routes[segment.link]
        ends = []
        for end in (segment.start, segment.end):
            vertex = end.vertex
            if vertex.cell is None:
                # The link continues through the layer.
                layer = vertex.layer_at(end.side)
                along = placed.starts[layer]
                along += placed.lengths[layer] if end.side == "last" else 0
            else:
                along = placed.cell(cells[vertex.cell], vertex.layer, vertex.length)
                along += vertex.length if end.side == "last" else 0
            ends.append((along, end.across))
        track = tracks_of.get(id(segment))
        path.append(ends[0])
        if track is not None:
            path += [(track, ends[0][1]), (track, ends[1][1])]
        path.append(ends[1])
    return [simplify(path) for path in routes]


def simplify(path: Sequence[Point]) -> list[Point]:
    """Remove repeated and collinear points."""
    found: list[Point] = []
    for point in path:
        if found and point == found[-1]:
            continue
        if len(found) > 1 and (
            found[-2][0] == found[-1][0] == point[0] or found[-2][1] == found[-1][1] == point[1]
        ):
            found.pop()
        found.append(point)
    return found
