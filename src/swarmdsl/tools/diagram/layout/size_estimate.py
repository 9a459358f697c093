"""Estimate the size of a container from its layers, in either direction."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from swarmdsl.base.records import dataclass, field
from swarmdsl.codegen.diagram.graph import Node
from swarmdsl.tools.diagram.layout.chains import LABEL_GAP, LINE_GAP, NODE_GAP
from swarmdsl.tools.diagram.layout.container_layout import along_across
from swarmdsl.tools.diagram.layout.edge_routes import EdgeRoutes
from swarmdsl.tools.diagram.layout.routing import TRACK
from swarmdsl.tools.diagram.layout.rows import lay_beside, starts_of_rows
from swarmdsl.tools.diagram.layout.simplex import Constraint, minimize
from swarmdsl.tools.diagram.layout.texts import Texts
from swarmdsl.tools.diagram.shapes import Direction

Size = tuple[int, int]
_PADDING = 18
_GAP = 24
"""Space between two layers without tracks."""
_BENDING = 0.5
"""Share of the edges between two layers that need a track."""


@dataclass
class _Layer:
    """Layer of a container: children, sizes of labels, and the number of lines that pass."""

    children: list[Node] = field(default_factory=list)
    labels: list[Size] = field(default_factory=list)
    lines: int = 0
    segments: int = 0

    def fixed(self, direction: Direction) -> tuple[list[str], int, int, int]:
        """Ids of the children, and what does not depend on their sizes.

        That are the length of the labels, the length of all else, and the breadth.
        """
        labels = [along_across(direction, *label) for label in self.labels]
        breadth = sum(across for _, across in labels) + LABEL_GAP * len(labels)
        return (
            [child.id for child in self.children],
            max((along for along, _ in labels), default=0),
            _GAP + round(self.segments * _BENDING) * TRACK,
            breadth + NODE_GAP * len(self.children) + LINE_GAP * self.lines,
        )


class Sizes:
    """Estimated sizes of the nodes of a diagram."""

    def __init__(self, routes: EdgeRoutes, texts: Texts) -> None:
        self._routes = routes
        self._texts = texts
        self._layers: dict[str, list[_Layer]] = {}
        self._fixed: dict[tuple[str, Direction], list[tuple[list[str], int, int, int]]] = {}
        self._turning: dict[str, int] = {}
        self._containers: dict[str, list[str]] = {}
        self._leaves: dict[str, dict[str, Size]] = {}
        self._known: dict[tuple[str, Direction, tuple[tuple[Direction, int], ...]], Size] = {}

    def of(self, frame: Node, directions: Mapping[str, Direction], rows: Mapping[str, int]) -> Size:
        """Width and height of the diagram."""
        if not frame.nodes:
            return self._leaf(frame)
        return self._size(frame, directions[frame.id], directions, rows)

    def layer_count(self, node: Node) -> int:
        """Return the number of layers of a container that may have rows, otherwise 1."""
        if node.id not in self._layers:
            self._layers[node.id] = self._layered(node)
        inner = self._routes.inner[node.id]
        ends = (self._routes.routes[number].legs[leg][1:] for number, leg in inner)
        if node.kind == "parallel" or node.ports or any(None in pair for pair in ends):
            return 1
        return len(self._layers[node.id])

    def _size(
        self,
        node: Node,
        around: Direction,
        directions: Mapping[str, Direction],
        rows: Mapping[str, int],
    ) -> Size:
        """Size of a container."""
        if node.id not in self._containers:
            self._containers[node.id] = [each.id for each in node.walk() if each.nodes]
            leaves = [child for child in node.nodes if not child.nodes]
            self._leaves[node.id] = {child.id: self._leaf(child) for child in leaves}
        inside = self._containers[node.id]
        key = (node.id, around, tuple([(directions[each], rows.get(each, 1)) for each in inside]))
        found = self._known.get(key)
        if found is None:
            direction = directions[node.id]
            sizes = dict(self._leaves[node.id])
            for child in node.nodes:
                if child.nodes:
                    sizes[child.id] = self._size(child, direction, directions, rows)
            found = self._known[key] = self._container(
                node, direction, around, sizes, rows.get(node.id, 1)
            )
        return found

    def _leaf(self, node: Node) -> Size:
        shape = self._texts.shape(node, "down")
        return shape.width, shape.height

    def _container(
        self,
        node: Node,
        direction: Direction,
        around: Direction,
        sizes: Mapping[str, Size],
        rows: int,
    ) -> Size:
        if node.id not in self._layers:
            self._layers[node.id] = self._layered(node)
        if (node.id, direction) not in self._fixed:
            layers = self._layers[node.id]
            if node.kind == "parallel":
                layers = [_Layer(list(node.nodes))]
            self._fixed[node.id, direction] = [layer.fixed(direction) for layer in layers]
        along, across = along_across(direction, 0, 1)
        layers_: list[Size] = []
        for children, least_length, more_length, more_breadth in self._fixed[node.id, direction]:
            layer_breadth = more_breadth
            for child in children:
                size = sizes[child]
                least_length = max(least_length, size[along])
                layer_breadth += size[across]
            layers_.append((least_length + more_length, layer_breadth))
        length, breadth = sum([size[0] for size in layers_]), max([size[1] for size in layers_])
        if rows > 1:
            crossed = [0, *(layer.segments for layer in self._layers[node.id])]
            length, breadth = wrapped_size(layers_, crossed, rows)
        if direction != around:
            length += self._turning.get(node.id, 0) * TRACK
        wide, high = along_across(direction, length, breadth)
        shape = self._texts.shape(node, "down")
        wide, high = wide + 2 * _PADDING, high + 2 * _PADDING + shape.height
        return max(wide, shape.width), high

    def _layered(self, node: Node) -> list[_Layer]:
        """Put the children of a container into layers."""
        index = {child.id: at for at, child in enumerate(node.nodes)}
        constraints: list[Constraint] = []
        legs = []
        for number, leg in self._routes.inner[node.id]:
            route = self._routes.routes[number]
            _, source, target = route.legs[leg]
            label: Size | None = None
            if leg == route.labelled and number in self._texts.labels:
                block = self._texts.labels[number]
                label = block.width, block.height
            legs.append((route, leg, source, target, label))
            if source is not None and target is not None:
                ends = (index[source], index[target])
                tail, head = ends[::-1] if route.flipped else ends
                if tail != head:
                    constraints.append((tail, head, 1 + (label is not None), 1))
        ranks = minimize(len(index), constraints)
        last = max(ranks, default=0)
        extra = any(label is not None for *_, label in legs)
        layers = [_Layer() for _ in range(last + 1 + 2 * extra)]
        for child, rank in zip(node.nodes, ranks, strict=True):
            layers[rank + extra].children.append(child)
        turning = 0
        for route, leg, source, target, label in legs:
            turning += source is None or target is None
            start = ranks[index[source]] + extra if source is not None else None
            stop = ranks[index[target]] + extra if target is not None else None
            if start is None:
                start = -1 if route.entry(leg) == "first" else len(layers)
            if stop is None:
                stop = -1 if route.exit(leg) == "first" else len(layers)
            low, high = min(start, stop), max(start, stop)
            for at in range(max(low, 0), min(high, len(layers))):
                layers[at].segments += 1
            for at in range(low + 1, high):
                layers[at].lines += 1
            if label is not None:
                at = start + (1 if stop > start else -1)
                layers[min(max(at, 0), len(layers) - 1)].labels.append(label)
        self._turning[node.id] = turning
        return [layer for layer in layers if layer.children or layer.labels]


def wrapped_size(layers: Sequence[Size], crossed: Sequence[int], rows: int) -> Size:
    """Length and breadth of layers of these sizes in a number of rows."""
    starts = starts_of_rows([length for length, _ in layers], crossed, rows)
    lengths: list[int] = []
    breadth = NODE_GAP * (len(starts) - 1)
    for start, stop in zip(starts, (*starts[1:], len(layers)), strict=True):
        breadth += max((across for _, across in layers[start:stop]), default=0)
        lengths = lay_beside(lengths, [length for length, _ in layers[start:stop]])
        if stop < len(layers):
            breadth += LINE_GAP * crossed[stop]
    return sum(lengths), breadth
