"""Lines between layers, with right angles; and with the room for them, places along.

What leads from one place across to another needs a track of its own where lines would lie on
each other; the order of the tracks makes few crossings (Sander: Layout of Directed Hypergraphs
with Orthogonal Hyperedges, 2004; here a greedy order as in Eades, Lin, Smyth 1993).
"""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.base.records import dataclass
from swarmdsl.tools.diagram.layout.level import Cell, Layers, Link, Placement, Point, Segment

TRACK = 10
"""Between two lines beside each other."""
_MARGIN = 16
"""Between the outermost line and a node: room for the head of an arrow."""
_LABEL_MARGIN = 8
_NEAR = 6
"""Lines nearer to each other than this look like one."""
_MOST_ORDERED = 80
_ON_EACH_OTHER = 1000


@dataclass
class _Bar:
    """The part of a segment that goes across, from `low` to `high`, on a track.

    `ups` and `downs` are where lines from it lead to the layer before and after.
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
    """Find where layers are along, and draw the lines.

    The cells of a layer begin in a row, or their middles are in one.
    """
    count = len(layers.layers)
    bars: list[list[_Bar]] = [[] for _ in range(count + 1)]
    for segment in layers.segments:
        if (bar := _bar(segment)) is not None:
            bars[segment.gap].append(bar)
    starts, lengths = [], []
    along = 0
    firsts = []
    for gap in range(count + 1):
        tracks = _tracks(bars[gap])
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
    placed = _Placed(starts, lengths, along, in_row)
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
        _labels(layers, links, placed, pitch),
    )


@dataclass
class _Placed:
    """Where layers begin along, how long they are, and where all ends."""

    starts: list[int]
    lengths: list[int]
    end: int
    in_row: bool

    def cell(self, cell: Cell, layer: int, length: int) -> int:
        """Where a cell is in its layer, or at the border."""
        if cell.border == "first":
            return 0
        if cell.border == "last":
            return self.end - length
        return self.starts[layer] if self.in_row else self.middle(layer, length)

    def middle(self, layer: int, length: int) -> int:
        return self.starts[layer] + (self.lengths[layer] - length) // 2


def _bar(segment: Segment) -> _Bar | None:
    """The part of a segment that goes across; None where it is straight."""
    start, end = segment.start.across, segment.end.across
    if start == end and not segment.turns:
        return None
    bar = _Bar(segment, min(start, end), max(start, end), [], [])
    for point in (segment.start, segment.end):
        (bar.ups if point.side == "last" else bar.downs).append(point.across)
    return bar


def _margins(layers: Layers, gap: int) -> tuple[int, int]:
    """The room before and after the tracks of a gap: more beside cells, where arrows may end."""

    def margin(layer: int) -> int:
        if not 0 <= layer < len(layers.layers):
            return 0
        inner = [vertex for vertex in layers.layers[layer] if vertex.length]
        return _MARGIN if any(vertex.cell is not None for vertex in inner) else _LABEL_MARGIN

    return margin(gap - 1), margin(gap)


def _tracks(bars: list[_Bar]) -> int:
    """Give each bar a track; return how many there are."""
    if not bars:
        return 0
    bars.sort(key=lambda bar: (bar.low, bar.high))
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
    place = _greedy(weight) if len(bars) <= _MOST_ORDERED else list(range(len(bars)))
    for at in sorted(range(len(bars)), key=place.__getitem__):
        tracks = [bars[each].track + 1 for each in before[at] if place[each] < place[at]]
        bars[at].track = max(tracks, default=0)
    return max(bar.track for bar in bars) + 1


def _cost(one: _Bar, other: _Bar) -> int:
    """How many lines cross, or lie on each other, if one bar is on a track before another's."""
    cost = sum(other.low < down < other.high for down in one.downs)
    cost += sum(one.low < up < one.high for up in other.ups)
    near = sum(abs(down - up) < _NEAR for down in one.downs for up in other.ups)
    return cost + _ON_EACH_OTHER * near


def _greedy(weight: Sequence[dict[int, int]]) -> list[int]:
    """A place for each bar: in turns, the one is next that gains most by being before the rest."""
    gain = [sum(each.values()) for each in weight]
    left = set(range(len(weight)))
    place = [0] * len(weight)
    for number in range(len(weight)):
        best = max(left, key=lambda at: (gain[at], -at))
        left.remove(best)
        place[best] = number
        for other, value in weight[best].items():
            gain[other] += value
    return place


def _routes(
    layers: Layers,
    cells: Sequence[Cell],
    links: Sequence[Link],
    placed: _Placed,
    tracks_of: dict[int, int],
) -> list[list[Point]]:
    """The way of each link, from its source to its target."""
    routes: list[list[Point]] = [[] for _ in links]
    for segment in layers.segments:
        way = routes[segment.link]
        ends = []
        for end in (segment.start, segment.end):
            vertex = end.vertex
            if vertex.cell is None:
                # It goes on through the layer.
                layer = vertex.layer_at(end.side)
                along = placed.starts[layer]
                along += placed.lengths[layer] if end.side == "last" else 0
            else:
                along = placed.cell(cells[vertex.cell], vertex.layer, vertex.length)
                along += vertex.length if end.side == "last" else 0
            ends.append((along, end.across))
        track = tracks_of.get(id(segment))
        way.append(ends[0])
        if track is not None:
            way += [(track, ends[0][1]), (track, ends[1][1])]
        way.append(ends[1])
    return [simplified(way) for way in routes]


def simplified(way: Sequence[Point]) -> list[Point]:
    """The same line without points on it that are no corners."""
    found: list[Point] = []
    for point in way:
        if found and point == found[-1]:
            continue
        if len(found) > 1 and (
            found[-2][0] == found[-1][0] == point[0] or found[-2][1] == found[-1][1] == point[1]
        ):
            found.pop()
        found.append(point)
    return found


def _labels(
    layers: Layers, links: Sequence[Link], placed: _Placed, pitch: int
) -> list[Point | None]:
    labels: list[Point | None] = [None] * len(links)
    for layer in layers.layers:
        for vertex in layer:
            if vertex.is_label and vertex.link is not None:
                across = vertex.across + (0 if vertex.line else pitch)
                labels[vertex.link] = (placed.middle(vertex.layer, vertex.length), across)
    return labels
