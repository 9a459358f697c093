"""Order the vertices in layers so that few edges cross.

Sweeps sort each layer by the mean position of neighbors, and adjacent vertices are swapped while
that helps (Gansner et al. 1993, section 3). Crossings are counted as in Barth, Juenger, Mutzel:
Simple and Efficient Bilayer Cross Counting (2002).
"""

from __future__ import annotations

from bisect import bisect_left, insort
from collections.abc import Sequence

from swarmdsl.tools.diagram.layout.layered_graph import End, Layers, Vertex

_SWEEPS, _PATIENCE = 16, 3
_ROUNDS = 10
_MAX_SORTED = 60_000
"""Maximum number of sorted vertices; large graphs get fewer sweeps."""
_MAX_SWAPPED = 400
"""Maximum number of vertices for which adjacent ones are swapped."""

Neighbours = dict[int, list[tuple[float, Vertex, float]]]
"""Neighbors by vertex id, with the relative positions of both ends of the edge."""


def order(
    layers: Layers, first: Sequence[Vertex] = (), last: Sequence[Vertex] = (), again: bool = False
) -> int:
    """Order and number the vertices of each layer; return the number of crossings.

    `first` and `last` are vertices at the border in the order that they have outside, which counts
    as a layer before and after all others. With `again`, the present order is improved.
    """
    before: Neighbours = {}
    after: Neighbours = {}
    for segment in layers.segments:
        if segment.turns or segment.uses_lane:
            continue
        upper, lower = segment.start, segment.end
        if upper.side == "first":
            upper, lower = lower, upper
        above, below = _relative_position(upper), _relative_position(lower)
        after.setdefault(id(upper.vertex), []).append((above, lower.vertex, below))
        before.setdefault(id(lower.vertex), []).append((below, upper.vertex, above))
    if not again:
        _initial_order(layers, before)
    outer = [_outer_layer(first), _outer_layer(last)]
    for place, vertex in enumerate(first):
        before[id(vertex)] = [(0.5, outer[0][place], 0.5)]
        after[id(outer[0][place])] = [(0.5, vertex, 0.5)]
    for place, vertex in enumerate(last):
        after[id(vertex)] = [(0.5, outer[1][place], 0.5)]
    counted = [outer[0], *layers.layers]
    count = sum(map(len, layers.layers))
    sweeps = min(_SWEEPS, _MAX_SORTED // max(count, 1))
    best, least = [list(layer) for layer in layers.layers], _crossings(counted, after)
    small = count <= _MAX_SWAPPED
    since = 0
    for sweep in range(sweeps):
        if not least or since == _PATIENCE:
            break
        since += 1
        if sweep % 2 == 0:
            for layer in layers.layers[not first :]:
                _sort(layer, before, sweep % 4 >= 2)
        else:
            for layer in reversed(layers.layers if last else layers.layers[:-1]):
                _sort(layer, after, sweep % 4 >= 2)
        if small:
            _swap_neighbours(layers, before, after)
        crossings = _crossings([outer[0], *layers.layers], after)
        if crossings < least:
            best, least, since = [list(layer) for layer in layers.layers], crossings, 0
    layers.layers[:] = best
    for layer in layers.layers:
        _number(layer)
    return least


def _outer_layer(inner: Sequence[Vertex]) -> list[Vertex]:
    """Return the ends outside of edges at the border, in order."""
    return [Vertex(0, 0, -1, order=place) for place in range(len(inner))]


def _initial_order(layers: Layers, before: Neighbours) -> None:
    """Start with the model order of nodes and of their incoming edges."""
    first: dict[int, int] = {}
    for segment in layers.segments:
        for end in (segment.start, segment.end):
            first.setdefault(id(end.vertex), segment.link)
    for layer in layers.layers:
        _number(layer)
        _sort(layer, before, False, first)


def _number(layer: list[Vertex]) -> None:
    for place, vertex in enumerate(layer):
        vertex.order = place


def _relative_position(end: End) -> float:
    """Relative position of an end on its side, added to the order of its vertex."""
    if end.at is None or not end.vertex.breadth:
        return 0.5
    return end.at / (end.vertex.breadth + 1)


def _sort(
    layer: list[Vertex],
    neighbours: Neighbours,
    reverse: bool,
    first: dict[int, int] | None = None,
) -> None:
    """Sort a layer by mean neighbor position; vertices without neighbors stay.

    Ties keep their order, or follow `first`.
    """
    keys: dict[int, float] = {}
    for vertex in layer:
        ends = neighbours.get(id(vertex))
        if ends:
            total = 0.0
            for _, other, part in ends:
                total += other.order + part
            keys[id(vertex)] = total / len(ends)
    moving = [vertex for vertex in layer if id(vertex) in keys]
    # Ties are reversed in every other sweep, which can reveal a better order.
    if len(moving) < 2:
        return
    moving.sort(
        key=lambda vertex: (
            keys[id(vertex)],
            first[id(vertex)] if first is not None else 0,
            -vertex.order if reverse else vertex.order,
        )
    )
    sorted_ = iter(moving)
    layer[:] = [next(sorted_) if id(vertex) in keys else vertex for vertex in layer]
    _number(layer)


def _swap_neighbours(layers: Layers, before: Neighbours, after: Neighbours) -> None:
    """Swap adjacent vertices as long as that removes crossings."""
    count = len(layers.layers)
    changed = set(range(count))
    for _ in range(_ROUNDS):
        # A layer stays as it is until one beside it changes.
        looked_at = sorted({at + by for at in changed for by in (-1, 0, 1)})
        changed.clear()
        for at in looked_at:
            if 0 <= at < count and _swap_in(layers.layers[at], before, after):
                changed.add(at)
        if not changed:
            return


def _swap_in(layer: list[Vertex], before: Neighbours, after: Neighbours) -> bool:
    """Swap adjacent vertices of a layer; return True if one was better."""
    # The adjacent layers do not change meanwhile.
    places = [
        [
            [other.order + part for _, other, part in neighbours.get(id(vertex), ())]
            for vertex in layer
        ]
        for neighbours in (before, after)
    ]
    better = False
    for place in range(len(layer) - 1):
        if sum(_gain(beside[place], beside[place + 1]) for beside in places) > 0:
            one, other = layer[place], layer[place + 1]
            layer[place], layer[place + 1] = other, one
            one.order, other.order = place + 1, place
            for beside in places:
                beside[place], beside[place + 1] = beside[place + 1], beside[place]
            better = True
    return better


def _gain(ones: list[float], others: list[float]) -> int:
    """Return the number of crossings removed by swapping two vertices, by neighbor positions."""
    return sum((a > b) - (a < b) for a in ones for b in others)


def _crossings(layers: Sequence[Sequence[Vertex]], after: Neighbours) -> int:
    total = 0
    for layer in layers:
        pairs = sorted(
            (vertex.order + part, other.order + end)
            for vertex in layer
            for part, other, end in after.get(id(vertex), ())
        )
        seen: list[float] = []
        for _, place in pairs:
            total += len(seen) - bisect_left(seen, place + 1e-9)
            insort(seen, place)
    return total
