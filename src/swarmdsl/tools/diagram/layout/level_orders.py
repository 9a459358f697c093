"""Order all levels of a diagram so that few edges cross, also across borders.

The order in which edges cross a border counts inside and outside of it. Levels are ordered from the
inside out, with crossings in the order of the level inside, and then from the outside in and back,
with the order outside as a further layer of each level. This is the hierarchical sweep of ELK:
Schulze, Spoenemann, von Hanxleden: Drawing Layered Graphs with Port Constraints (2014), section 7.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping, Sequence

from swarmdsl.codegen.diagram.graph import Node
from swarmdsl.tools.diagram.layout.layered_graph import Side, Vertex
from swarmdsl.tools.diagram.layout.level import Level

_ROUNDS = 3
_MAX_SWEPT = 2_000
"""Maximum number of vertices for which levels are ordered again."""
_SCALE = 1000
"""Extent of a side on which crossings have their places before they have coordinates."""

_Places = dict[tuple[str, int], int]
"""Positions on the border of a container, by its id and the number of the edge."""
_Wishes = dict[int, tuple[Side, float]]
"""Side and order of the crossings of a border in the level around it, by number of the edge."""


def order_levels(frame: Node, levels: Mapping[str, Level]) -> None:
    """Order the layers of all levels."""
    nested = [levels[node.id] for node in frame.walk() if node.id in levels]
    orders = _Orders(nested)
    orders.inside_out({})
    least, best = orders.crossings(), orders.taken()
    count = sum(len(layer) for level in nested for layer in level.layers.layers)
    crossed = any(level.border.cells for level in nested)
    for _ in range(_ROUNDS if crossed and count <= _MAX_SWEPT else 0):
        if not least:
            break
        orders.outside_in()
        orders.inside_out(orders.wishes)
        if (found := orders.crossings()) >= least:
            break
        least, best = found, orders.taken()
    orders.restore(best)
    for level in nested:
        for child in level.node.nodes:
            if child.id in levels and not level.beside:
                _insert_reserved(level, levels[child.id])


def _insert_reserved(level: Level, inner: Level) -> None:
    """Put the reserved places on the border of a container between those of its crossings.

    Each is where the order around the container has its edge, so that it crosses none there.
    """
    if not inner.reserved:
        return
    others = level.other_ends(inner.node.id, [number for number, _ in inner.border.cells])
    for side, at in (("first", 0), ("last", -1)):
        layer = inner.layers.layers[at]
        fixed: list[tuple[tuple[int, int], Vertex]] = []
        free: list[tuple[tuple[int, int], Vertex]] = []
        for (number, where), cell in inner.border.cells.items():
            if where == side and number in others:
                end = others[number]
                key = (end.vertex.order, end.at or 0)
                vertex = inner.layers.cells[cell + inner.titled]
                (free if number in inner.reserved else fixed).append((key, vertex))
        crossed = sorted(key for key, _ in fixed)
        on_border = sorted(
            (vertex for _, vertex in fixed),
            key=lambda each: each.order,
            reverse=inner.border.turns,
        )
        free.sort(key=lambda each: each[0])
        for rank in range(len(on_border) + 1):
            added = [each for key, each in free if bisect_left(crossed, key) == rank]
            if inner.border.turns:
                added.reverse()
            if rank < len(on_border):
                place = layer.index(on_border[rank]) + inner.border.turns
            else:
                # Beyond all others outside.
                place = 0 if inner.border.turns else len(layer)
            layer[place:place] = added
        for number, vertex in enumerate(layer):
            vertex.order = number


class _Orders:
    """Orders of all levels, from the outside in, while they are improved."""

    def __init__(self, levels: Sequence[Level]) -> None:
        self.levels = levels
        self.ends = {level.node.id: level.crossing_ends() for level in levels}
        self.inner = {level.node.id: level for level in levels}
        self.places: _Places = {}
        self.wishes: dict[str, _Wishes] = {}
        self._count: dict[str, int] = {}

    def inside_out(self, wishes: Mapping[str, _Wishes]) -> None:
        for level in reversed(self.levels):
            self._order(level, wishes.get(level.node.id, {}))
            self._place(level)

    def outside_in(self) -> None:
        for level in self.levels:
            id_ = level.node.id
            wishes = self.wishes.get(id_, {})
            if wishes:
                self._order(level, wishes)
            self._wish(level, wishes)

    def _order(self, level: Level, wishes: _Wishes) -> None:
        """Order a level between the positions inside of its nodes and those around it."""
        if level.beside:
            return
        for number, child, end, _ in self.ends[level.node.id]:
            end.vertex.breadth = _SCALE
            end.at = self.places[child, number]
        around: dict[Side, list[tuple[float, Vertex]]] = {"first": [], "last": []}
        for (number, side), cell in level.border.cells.items():
            if number in wishes:
                at = level.layers.cells[cell + level.titled]
                around[side].append((wishes[number][1], at))
        outside: list[list[Vertex]] = []
        for pairs in around.values():
            pairs.sort(key=lambda pair: pair[0])
            outside.append([vertex for _, vertex in pairs])
        self._count[level.node.id] = level.ordering.improve(*outside)

    def _place(self, level: Level) -> None:
        """Give the crossings of a level their places for the level around it."""
        keys: dict[Side, list[tuple[tuple[float, ...], int]]] = {"first": [], "last": []}
        region = {child.id: at for at, child in enumerate(level.node.nodes)}
        inside = {
            number: (float(region[child]), float(self.places[child, number]))
            for number, child, _, _ in self.region_ends(level)
        }
        for (number, side), cell in level.border.cells.items():
            if number in level.reserved:
                continue
            if level.beside:
                keys[side].append((inside.get(number, (0.0, 0.0)), number))
            else:
                at = level.layers.cells[cell + level.titled].order
                keys[side].append(((float(at),), number))
        for found in keys.values():
            found.sort(reverse=level.border.turns)
            for rank, (_, number) in enumerate(found, 1):
                self.places[level.node.id, number] = _SCALE * rank // (len(found) + 1)

    def region_ends(self, level: Level) -> list[tuple[int, str, None, None]]:
        """Edges that cross the regions of a level."""
        if not level.beside:
            return []
        found = []
        for number in level.numbers:
            for container, source, target in level.routes.routes[number].legs:
                region = source if source is not None else target
                if container == level.node.id and (region, number) in self.places:
                    assert region is not None
                    found.append((number, region, None, None))
        return found

    def _wish(self, level: Level, wishes: _Wishes) -> None:
        """Tell the levels inside the order of their crossings in this one."""
        turned: list[tuple[int, str, Side, float]] = []
        if level.beside:
            for number, region, _, _ in self.region_ends(level):
                if number in wishes:
                    turned.append((number, region, *wishes[number]))
        else:
            for number, child, end, other in self.ends[level.node.id]:
                at = other.at / (other.vertex.breadth + 1) if other.at else 0.5
                turned.append((number, child, end.side, other.vertex.order + at))
        for number, child, side, value in turned:
            inner = self.inner[child]
            sign = -1 if inner.border.turns else 1
            self.wishes.setdefault(child, {})[number] = side, sign * value

    def crossings(self) -> int:
        return sum(self._count.values())

    def taken(self) -> list[list[list[int]]]:
        return [level.ordering.taken() for level in self.levels]

    def restore(self, taken: Sequence[Sequence[Sequence[int]]]) -> None:
        for level, layers in zip(self.levels, taken, strict=True):
            level.ordering.restore(layers)
