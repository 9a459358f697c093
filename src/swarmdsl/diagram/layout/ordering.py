"""The order within layers in which few edges cross.

Sweeps that sort each layer by the mean place of its neighbours, and exchanges of neighbours
while that helps: Gansner et al. 1993, section 3; crossings are counted as in Barth, Juenger,
Mutzel: Simple and Efficient Bilayer Cross Counting (2002).
"""

from __future__ import annotations

from bisect import bisect_left, insort

from swarmdsl.diagram.layout.level import End, Layers, Vertex

_SWEEPS, _PATIENCE = 16, 4
_WORK = 60_000
"""Vertices that are sorted: very large graphs are swept less often."""
_EXCHANGED = 400
"""Vertices in layers in which neighbours are exchanged; in larger graphs it takes too long."""

Neighbours = dict[int, list[tuple[End, End]]]


def order(layers: Layers) -> None:
    """Put the vertices of each layer in order, and number them."""
    before: Neighbours = {}
    after: Neighbours = {}
    for segment in layers.segments:
        if segment.turns:
            continue
        upper, lower = segment.start, segment.end
        if upper.side == "first":
            upper, lower = lower, upper
        after.setdefault(id(upper.vertex), []).append((upper, lower))
        before.setdefault(id(lower.vertex), []).append((lower, upper))
    _begin(layers, before)
    best, least = [list(layer) for layer in layers.layers], _crossings(layers, after)
    count = sum(map(len, layers.layers))
    small = count <= _EXCHANGED
    since = 0
    for sweep in range(min(_SWEEPS, _WORK // max(count, 1))):
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


def _place(end: End) -> float:
    """Where a neighbour is: its number, and how far along its side the edge ends."""
    vertex = end.vertex
    if end.at is None or not vertex.breadth:
        return vertex.order + 0.5
    return vertex.order + end.at / (vertex.breadth + 1)


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
            keys[id(vertex)] = sum(_place(other) for _, other in ends) / len(ends)
    moving = [vertex for vertex in layer if id(vertex) in keys]
    # Those that are equal change places in every other sweep, which may show a better order.
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
    better = True
    rounds = 0
    while better and rounds < 10:
        better = False
        rounds += 1
        for layer in layers.layers:
            for place in range(len(layer) - 1):
                one, other = layer[place], layer[place + 1]
                gain = 0
                for neighbours in (before, after):
                    ones = [_place(end) for _, end in neighbours.get(id(one), ())]
                    others = [_place(end) for _, end in neighbours.get(id(other), ())]
                    gain += sum(a > b for a in ones for b in others)
                    gain -= sum(a < b for a in ones for b in others)
                if gain > 0:
                    layer[place], layer[place + 1] = other, one
                    one.order, other.order = place + 1, place
                    better = True


def _crossings(layers: Layers, after: Neighbours) -> int:
    total = 0
    for layer in layers.layers:
        pairs = sorted(
            (_place(upper), _place(lower))
            for vertex in layer
            for upper, lower in after.get(id(vertex), ())
        )
        seen: list[float] = []
        for _, place in pairs:
            total += len(seen) - bisect_left(seen, place + 1e-9)
            insort(seen, place)
    return total
