"""Estimate the size of a container from its layers, in either direction."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.base.records import dataclass, field
from swarmdsl.codegen.diagram.graph import Diagram, Node
from swarmdsl.tools.diagram.layout.container_layout import along_across
from swarmdsl.tools.diagram.layout.edge_routes import EdgeRoutes
from swarmdsl.tools.diagram.layout.routing import TRACK
from swarmdsl.tools.diagram.layout.simplex import Constraint, minimize
from swarmdsl.tools.diagram.layout.straightening import LABEL_GAP, LINE_GAP, NODE_GAP
from swarmdsl.tools.diagram.shapes import Direction, Shape, shape_of
from swarmdsl.tools.diagram.text_blocks import label_block

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


class Sizes:
    """Estimated sizes of the nodes of a diagram."""

    def __init__(self, diagram: Diagram, routes: EdgeRoutes) -> None:
        self._diagram = diagram
        self._routes = routes
        self._layers: dict[str, list[_Layer]] = {}
        self._shapes: dict[str, Shape] = {}
        self._turning: dict[str, int] = {}
        self._containers: dict[str, tuple[str, ...]] = {}
        self._known: dict[tuple[str, Direction, tuple[Direction, ...]], Size] = {}

    def of(self, frame: Node, directions: Mapping[str, Direction]) -> Size:
        """Width and height of the diagram."""
        return self._size(frame, directions[frame.id], directions)

    def _size(self, node: Node, around: Direction, directions: Mapping[str, Direction]) -> Size:
        if not node.nodes:
            shape = self._shape(node)
            return shape.width, shape.height
        turned = tuple(directions[each] for each in self._inside(node))
        key = (node.id, around, turned)
        if key not in self._known:
            direction = directions[node.id]
            inner = {child.id: self._size(child, direction, directions) for child in node.nodes}
            self._known[key] = self._container(node, direction, around, inner)
        return self._known[key]

    def _shape(self, node: Node) -> Shape:
        if node.id not in self._shapes:
            self._shapes[node.id] = shape_of(node, "down", self._routes.right_ports)
        return self._shapes[node.id]

    def _inside(self, node: Node) -> tuple[str, ...]:
        """Return the containers in a node, from itself down."""
        if node.id not in self._containers:
            self._containers[node.id] = tuple(each.id for each in node.walk() if each.nodes)
        return self._containers[node.id]

    def _container(
        self, node: Node, direction: Direction, around: Direction, sizes: Mapping[str, Size]
    ) -> Size:
        if node.id not in self._layers:
            self._layers[node.id] = self._layered(node)
        shape = self._shape(node)
        layers = self._layers[node.id]
        if node.kind == "parallel":
            layers = [_Layer(list(node.nodes))]
        length = breadth = 0
        for layer in layers:
            boxes = [along_across(direction, *sizes[child.id]) for child in layer.children]
            labels = [along_across(direction, *label) for label in layer.labels]
            length += max((along for along, _ in (*boxes, *labels)), default=0)
            length += _GAP + round(layer.segments * _BENDING) * TRACK
            across = sum(size for _, size in boxes) + NODE_GAP * len(boxes)
            across += sum(size for _, size in labels) + LABEL_GAP * len(labels)
            breadth = max(breadth, across + LINE_GAP * layer.lines)
        if direction != around:
            length += self._turning.get(node.id, 0) * TRACK
        wide, high = along_across(direction, length, breadth)
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
            if leg == route.labelled and route.edge.label:
                block = label_block(route.edge.label)
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
