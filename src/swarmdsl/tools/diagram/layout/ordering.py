"""The order within layers in which few edges cross.

Sweeps that sort each layer by the mean place of its neighbours, and exchanges of neighbours
while that helps: Gansner et al. 1993, section 3; crossings are counted as in Barth, Juenger,
Mutzel: Simple and Efficient Bilayer Cross Counting (2002).
"""

from __future__ import annotations

from bisect import bisect_left, insort

from swarmdsl.tools.diagram.layout.level import End, Layers, Vertex

_SWEEPS, _PATIENCE = 16, 3
_ROUNDS = 10
_WORK = 60_000
"""Vertices that are sorted: very large graphs are swept less often."""
_EXCHANGED = 400
"""Vertices in layers in which neighbours are exchanged; in larger graphs it takes too long."""

Neighbours = dict[int, list[tuple[float, Vertex, float]]]
"""By the id of a vertex: its neighbours, with how far along its side and theirs the edge ends."""


def order(layers: Layers) -> None:
    """Put the vertices of each layer in order, and number them."""
    before: Neighbours = {}
    after: Neighbours = {}
    for segment in layers.segments:
        if segment.turns or segment.is_aside:
            continue
        upper, lower = segment.start, segment.end
        if upper.side == "first":
            upper, lower = lower, upper
        above, below = _part(upper), _part(lower)
        after.setdefault(id(upper.vertex), []).append((above, lower.vertex, below))
        before.setdefault(id(lower.vertex), []).append((below, upper.vertex, above))
    _begin(layers, before)
    count = sum(map(len, layers.layers))
    sweeps = min(_SWEEPS, _WORK // max(count, 1))
    if not sweeps:
        return
    best, least = [list(layer) for layer in layers.layers], _crossings(layers, after)
    small = count <= _EXCHANGED
    since = 0
    for sweep in range(sweeps):
        if not least or since == _PATIENCE:
            break
        since += 1
        if sweep % 2 == 0:
            for layer in layers.layers[1:]:
                _sort(layer, before, sweep % 4 >= 2)
        else:
            for layer in reversed(layers.layers[:-1]):
                _sort(layer, after, sweep % 4 >= 2)
        if small:
            _exchange(layers, before, after)
        crossings = _crossings(layers, after)
        if crossings < least:
            best, least, since = [list(layer) for layer in layers.layers], crossings, 0
    layers.layers[:] = best
    for layer in layers.layers:
        _number(layer)


def _begin(layers: Layers, before: Neighbours) -> None:
    """Begin with the order of the model, of nodes and of the edges that lead to them."""
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


def _part(end: End) -> float:
    """How far along its side of a vertex an edge ends; with its number that is its place."""
    if end.at is None or not end.vertex.breadth:
        return 0.5
    return end.at / (end.vertex.breadth + 1)


def _sort(
    layer: list[Vertex],
    neighbours: Neighbours,
    reverse: bool,
    first: dict[int, int] | None = None,
) -> None:
    """Sort a layer by means; vertices without neighbours stay where they are.

    Of two with the same, the one is before that was so, or that comes `first`.
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
    # Those that are equal change places in every other sweep, which may show a better order.
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


def _exchange(layers: Layers, before: Neighbours, after: Neighbours) -> None:
    """Exchange neighbours in a layer as long as fewer edges cross then."""
    for _ in range(_ROUNDS):
        better = False
        for layer in layers.layers:
            # In the layers beside it, nothing changes meanwhile.
            places = [
                {
                    id(vertex): [
                        other.order + part for _, other, part in neighbours.get(id(vertex), ())
                    ]
                    for vertex in layer
                }
                for neighbours in (before, after)
            ]
            for place in range(len(layer) - 1):
                one, other = layer[place], layer[place + 1]
                if sum(_gain(beside[id(one)], beside[id(other)]) for beside in places) > 0:
                    layer[place], layer[place + 1] = other, one
                    one.order, other.order = place + 1, place
                    better = True
        if not better:
            return


def _gain(ones: list[float], others: list[float]) -> int:
    """How many crossings fewer it makes that two vertices change places, by their neighbours."""
    return sum((a > b) - (a < b) for a in ones for b in others)


def _crossings(layers: Layers, after: Neighbours) -> int:
    total = 0
    for layer in layers.layers:
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
