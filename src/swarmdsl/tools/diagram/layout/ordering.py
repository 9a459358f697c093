"""Order the vertices in layers so that few edges cross.

Sweeps sort each layer by the mean position of neighbors, and adjacent vertices are swapped while
that helps (Gansner et al. 1993, section 3). Crossings are counted as in Barth, Juenger, Mutzel:
Simple and Efficient Bilayer Cross Counting (2002).
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Container, Iterable, Sequence

from swarmdsl.tools.diagram.layout.layered_graph import End, Layers, Vertex

_SWEEPS, _PATIENCE = 16, 3
_ROUNDS = 10
_MAX_SORTED = 60_000
"""Maximum number of sorted vertices; large graphs get fewer sweeps."""
_MAX_SWAPPED = 400
"""Maximum number of vertices for which adjacent ones are swapped."""
_SCALE = 1 << 16
"""Distance of two vertices in a layer, divided by the ends on their sides."""


class Ordering:
    """Order of the vertices in the layers of a graph, while it is improved.

    Vertices have numbers, as have the ends of segments: the upper end of a segment and, one more,
    its lower end in the next layer. The order outside of the border counts as a layer before and
    after all others.
    """

    def __init__(self, graph: Layers) -> None:
        self._graph = graph
        self._vertices = [vertex for layer in graph.layers for vertex in layer]
        self._number = {id(vertex): number for number, vertex in enumerate(self._vertices)}
        numbers = iter(range(len(self._vertices)))
        self._layers = [[next(numbers) for _ in layer] for layer in graph.layers]
        # For each vertex: its ends, and the other ends of their segments above and below.
        self._own: list[list[int]] = [[] for _ in self._vertices]
        self._above: list[list[int]] = [[] for _ in self._vertices]
        self._below: list[list[int]] = [[] for _ in self._vertices]
        # For the gap before each layer, and the one after all: the upper ends of its segments.
        self._gaps: list[list[int]] = [[] for _ in range(len(graph.layers) + 1)]
        self._ends: list[End] = []
        self._model_order = [0] * len(self._vertices)
        for segment in reversed(graph.segments):
            for end in (segment.start, segment.end):
                if id(end.vertex) in self._number:
                    self._model_order[self._number[id(end.vertex)]] = segment.link
        for segment in graph.segments:
            if not (segment.turns or segment.uses_lane):
                upper, lower = segment.start, segment.end
                if upper.side == "first":
                    upper, lower = lower, upper
                above, below = self._number[id(upper.vertex)], self._number[id(lower.vertex)]
                self._connect(segment.gap, above, below, len(self._ends))
                self._ends += (upper, lower)
        self._outside: list[list[int]] = [[], []]
        # Positions of ends, and these relative to their vertices.
        self._position = [0] * len(self._ends)
        self._part = [_part(end) for end in self._ends]
        self._at_cells = [
            number for number, end in enumerate(self._ends) if end.vertex.cell is not None
        ]
        self._counts: list[int | None] = [0] * len(self._gaps)
        self._is_sorted = False

    def _connect(self, gap: int, above: int | None, below: int | None, end: int) -> None:
        """Add a segment between two vertices, or between one and a place outside."""
        self._gaps[gap].append(end)
        if above is not None:
            self._own[above].append(end)
            self._below[above].append(end + 1)
        if below is not None:
            self._own[below].append(end + 1)
            self._above[below].append(end)

    def improve(self, first: Sequence[Vertex] = (), last: Sequence[Vertex] = ()) -> int:
        """Improve the order; return the number of crossings.

        `first` and `last` are vertices at the border in the order that they have outside.
        """
        count = len(self._layers)
        changed = self._set_outside(first, last)
        for number in self._at_cells:
            self._part[number] = _part(self._ends[number])
        for at in range(count):
            if self._update(at):
                changed.add(at)
            if not self._is_sorted:
                self._sort_as_in_model(at)
        self._is_sorted = True
        best, least = self.taken(), self._crossings()
        if not changed:
            return least
        sweeps = min(_SWEEPS, _MAX_SORTED // max(len(self._vertices), 1))
        swaps = len(self._vertices) <= _MAX_SWAPPED
        since = 0
        for sweep in range(sweeps):
            if not least or since == _PATIENCE:
                break
            since += 1
            if sweep % 2 == 0:
                way, neighbors = range(not first, count), self._above
            else:
                way, neighbors = range(count - 1 - (not last), -1, -1), self._below
            changed.update([at for at in way if self._sort(at, neighbors, sweep % 4 >= 2)])
            if swaps:
                self._swap_neighbors(changed)
                changed.clear()
            if (found := self._crossings()) < least:
                best, least, since = self.taken(), found, 0
        self.restore(best)
        return least

    def taken(self) -> list[list[int]]:
        """Return the present order."""
        return [list(layer) for layer in self._layers]

    def restore(self, taken: Sequence[Sequence[int]]) -> None:
        """Take an order that was there before, also into the graph."""
        for at, (numbers, layer) in enumerate(zip(taken, self._graph.layers, strict=True)):
            if numbers != self._layers[at]:
                self._layers[at] = list(numbers)
                self._update(at)
            layer[:] = [self._vertices[number] for number in numbers]
            for place, vertex in enumerate(layer):
                vertex.order = place

    def _set_outside(self, first: Sequence[Vertex], last: Sequence[Vertex]) -> set[int]:
        """Connect vertices at the border with their places outside; return the layers changed."""
        outside = [[self._number[id(vertex)] for vertex in each] for each in (first, last)]
        if outside == self._outside:
            return set() if self._is_sorted else set(range(len(self._layers)))
        for numbers, neighbors, gap in zip(
            self._outside, (self._above, self._below), (0, -1), strict=True
        ):
            for number in numbers:
                self._own[number].pop()
                neighbors[number].clear()
            self._gaps[gap].clear()
            self._counts[gap] = None
        del self._position[len(self._ends) :], self._part[len(self._ends) :]
        self._outside = outside
        for is_last, numbers in enumerate(outside):
            for place, number in enumerate(numbers):
                end = len(self._position)
                self._position += (place * _SCALE, place * _SCALE)
                self._part += (_SCALE // 2, _SCALE // 2)
                if is_last:
                    self._connect(-1, number, None, end)
                else:
                    self._connect(0, None, number, end)
        return {0, len(self._layers) - 1}

    def _update(self, at: int) -> bool:
        """Set the positions of the ends in a layer; return True if that changes one."""
        position, part, own = self._position, self._part, self._own
        changed = False
        place = 0
        for number in self._layers[at]:
            for end in own[number]:
                if position[end] != place + part[end]:
                    position[end] = place + part[end]
                    changed = True
            place += _SCALE
        if changed:
            self._counts[at] = self._counts[at + 1] = None
        return changed

    def _means(self, at: int, neighbors: Sequence[Sequence[int]]) -> dict[int, float]:
        """Mean positions of the neighbors of the vertices in a layer, of those that have some."""
        position = self._position.__getitem__
        return {
            number: sum(map(position, neighbors[number])) / len(neighbors[number])
            for number in self._layers[at]
            if neighbors[number]
        }

    def _sort_as_in_model(self, at: int) -> None:
        """Start with the order of nodes in the model, and of the edges that enter them."""
        keys, links = self._means(at, self._above), self._model_order
        self._place(at, keys, sorted(keys, key=lambda number: (keys[number], links[number])))

    def _sort(self, at: int, neighbors: Sequence[Sequence[int]], reverse: bool) -> bool:
        """Sort a layer by mean neighbor position; return True if that changes it.

        Vertices without neighbors stay. Ties are reversed in every other sweep, which can reveal a
        better order.
        """
        keys = self._means(at, neighbors)
        numbers = list(keys)
        moved = sorted(reversed(numbers) if reverse else numbers, key=keys.__getitem__)
        if moved == numbers:
            return False
        self._place(at, keys, moved)
        return True

    def _place(self, at: int, moving: Container[int], order: Iterable[int]) -> None:
        """Order the vertices of a layer that move; the others stay."""
        each = iter(order)
        self._layers[at] = [
            next(each) if number in moving else number for number in self._layers[at]
        ]
        self._update(at)

    def _swap_neighbors(self, changed: Iterable[int]) -> None:
        """Swap adjacent vertices as long as that removes crossings.

        Layers that did not change, nor those beside them, are not looked at.
        """
        for _ in range(_ROUNDS):
            beside = {at + by for at in changed for by in (-1, 0, 1)}
            changed = [at for at in sorted(beside) if self._swap_in(at)]
            if not changed:
                return

    def _swap_in(self, at: int) -> bool:
        """Swap adjacent vertices of a layer; return True if one was better."""
        if not 0 <= at < len(self._layers) or not (self._count(at) or self._count(at + 1)):
            return False
        layer, position = self._layers[at], self._position.__getitem__
        # The adjacent layers do not change meanwhile.
        above = [sorted(map(position, self._above[number])) for number in layer]
        below = [sorted(map(position, self._below[number])) for number in layer]
        better = False
        for place in range(len(layer) - 1):
            up, next_up, down, next_down = *above[place : place + 2], *below[place : place + 2]
            # Without crossings between the two, nothing can be gained.
            if (
                (up and next_up and up[-1] > next_up[0])
                or (down and next_down and down[-1] > next_down[0])
            ) and _gain(up, next_up) + _gain(down, next_down) > 0:
                layer[place : place + 2] = layer[place + 1], layer[place]
                above[place : place + 2] = next_up, up
                below[place : place + 2] = next_down, down
                better = True
        if better:
            self._update(at)
        return better

    def _crossings(self) -> int:
        return sum(map(self._count, range(len(self._gaps))))

    def _count(self, gap: int) -> int:
        """Count the crossings between two layers, unless they are known."""
        known = self._counts[gap]
        if known is None:
            known = self._counts[gap] = self._count_again(gap)
        return known

    def _count_again(self, gap: int) -> int:
        position = self._position
        total = 0
        seen: list[int] = []
        for _, place in sorted([(position[end], position[end + 1]) for end in self._gaps[gap]]):
            if seen and place < seen[-1]:
                at = bisect_right(seen, place)
                total += len(seen) - at
                seen.insert(at, place)
            else:
                seen.append(place)
        return total


def _part(end: End) -> int:
    """Position of an end on its side, relative to its vertex."""
    if end.at is None or not end.vertex.breadth:
        return _SCALE // 2
    return end.at * _SCALE // (end.vertex.breadth + 1)


def _gain(ones: Sequence[int], others: Sequence[int]) -> int:
    """Return the number of crossings removed by swapping two vertices, by neighbor positions."""
    return sum((a > b) - (a < b) for a in ones for b in others)
