"""Compute the layout of a diagram."""

from __future__ import annotations

from collections.abc import Iterator
from math import sqrt

from swarmdsl.base.records import dataclass
from swarmdsl.codegen.diagram.graph import Diagram, Edge, Node, Port
from swarmdsl.tools.diagram.layout.compound import Compound
from swarmdsl.tools.diagram.layout.directions import choose_directions, fitted_size, uniform
from swarmdsl.tools.diagram.layout.edge_routes import EdgeRoutes
from swarmdsl.tools.diagram.layout.routing import simplify
from swarmdsl.tools.diagram.layout.texts import Texts
from swarmdsl.tools.diagram.measure import width
from swarmdsl.tools.diagram.shapes import PORT, PSEUDO_STATES, Direction, port_text
from swarmdsl.tools.diagram.text_blocks import Block

_MAX_TRIED = 60
"""Maximum number of nodes for which both directions of the whole are tried."""


@dataclass(frozen=True, slots=True)
class Box:
    """A placed node; edges end on its `core`.

    `divider` is the path of the line before a region, empty for the first one. A region without
    divider has its own border.
    """

    node: Node
    x: int
    y: int
    width: int
    height: int
    core: tuple[int, int, int, int]
    block: Block
    divider: str | None = None


@dataclass(frozen=True, slots=True)
class Pin:
    """A placed port: its center and, outside of boxes, the x of its name."""

    port: Port
    x: int
    y: int
    name_x: int | None = None


@dataclass(frozen=True, slots=True)
class Line:
    """A placed edge with right angles, and its label."""

    edge: Edge
    points: tuple[tuple[int, int], ...]
    label: Block | None
    label_x: int = 0
    label_y: int = 0


@dataclass(frozen=True, slots=True)
class Picture:
    """A laid-out diagram: boxes from the outside in, lines and ports."""

    diagram: Diagram
    width: int
    height: int
    boxes: tuple[Box, ...]
    lines: tuple[Line, ...]
    pins: tuple[Pin, ...]


def lay_out(diagram: Diagram, direction: Direction | None = None) -> Picture:
    """Lay out a diagram; without a direction, each level in the one that fits a page best."""
    routes = EdgeRoutes(diagram)
    texts = Texts(diagram, routes.right_ports)
    if direction is None and diagram.kind != "statechart":
        direction = "right" if diagram.kind == "internal" else "down"
    if direction is not None:
        return _picture(Compound(diagram, routes, texts, uniform(diagram, direction), {}))
    choices = list(choose_directions(diagram, routes, texts))
    if len(routes.nodes) > _MAX_TRIED:
        choices = choices[:1]
    pictures = [_picture(Compound(diagram, routes, texts, *each)) for each in choices]
    return min(pictures, key=lambda each: fitted_size(each.width, each.height))


def _picture(compound: Compound) -> Picture:
    frame = compound.diagram.frame
    boxes: list[Box] = []
    pins: list[Pin] = []
    corners: dict[str, tuple[int, int]] = {}
    for node, x, y in _positions(compound, frame, 0, 0):
        inside = compound.layouts[node.id]
        corners[node.id] = x, y
        wide, high = inside.width, inside.height
        core_x, core_y, core_wide, core_high = inside.shape.core
        if node.kind not in PSEUDO_STATES:
            core_x, core_y, core_wide, core_high = 0, 0, wide, high
        core = (x + core_x, y + core_y, core_wide, core_high)
        divider = None
        parent = compound.edge_routes.parents.get(node.id)
        if parent is not None and compound.layouts[parent].regions:
            is_first = node is compound.edge_routes.nodes[parent].nodes[0]
            divider = f"v{high}" if compound.directions[parent] == "down" else f"h{wide}"
            divider = "" if is_first else divider
        boxes.append(Box(node, x, y, wide, high, core, inside.shape.block, divider))
        centres = {id_: (port_x, port_y) for id_, port_x, port_y in inside.shape.ports}
        for port in node.ports:
            if port.id in centres:
                dx, dy = centres[port.id]
                pins.append(Pin(port, x + dx, y + dy))
            else:
                dx, dy = inside.ports[port.id]
                name_x = 9 if not dx else dx - 9 - width(port_text(port), "line")
                pins.append(Pin(port, x + dx, y + dy, x + name_x))
    cores = {box.node.id: box for box in boxes}
    lines = [
        _line(compound, number, edge, corners, cores)
        for number, edge in enumerate(compound.diagram.edges)
    ]
    outer = compound.layouts[frame.id]
    return Picture(
        compound.diagram, outer.width, outer.height, tuple(boxes), tuple(lines), tuple(pins)
    )


def _positions(compound: Compound, node: Node, x: int, y: int) -> Iterator[tuple[Node, int, int]]:
    yield node, x, y
    for child in node.nodes:
        dx, dy = compound.layouts[node.id].children[child.id]
        yield from _positions(compound, child, x + dx, y + dy)


def _line(
    compound: Compound,
    number: int,
    edge: Edge,
    corners: dict[str, tuple[int, int]],
    boxes: dict[str, Box],
) -> Line:
    label = compound.labels.get(number)
    if number not in compound.edge_routes.routes:
        x, y = corners[edge.source]
        loops = compound.layouts[edge.source].own_loops
        loop = next(each for each in loops if each.edge == number)
        loop_points = tuple((x + dx, y + dy) for dx, dy in loop.points)
        at = loop.label or (0, 0)
        return Line(edge, loop_points, label, x + at[0], y + at[1])
    points: list[tuple[int, int]] = []
    label_at = (0, 0)
    for container, _, _ in compound.edge_routes.routes[number].legs:
        inside, (x, y) = compound.layouts[container], corners[container]
        points += ((x + dx, y + dy) for dx, dy in inside.segments_of[number])
        if number in inside.labels:
            dx, dy = inside.labels[number]
            label_at = (x + dx, y + dy)
    points = simplify(points)
    for end, then, node in ((0, 1, edge.source), (-1, -2, edge.target)):
        if edge.source_port is not None:
            points[end] = _end_on_port(points[end], points[then])
        else:
            points[end] = _end_on_border(points[end], points[then], boxes[node])
    return Line(edge, tuple(simplify(points)), label, *label_at)


def _end_on_port(end: tuple[int, int], before: tuple[int, int]) -> tuple[int, int]:
    """End of a line on the square of a port, which it meets from the left or right."""
    return end[0] + (PORT // 2 if before[0] > end[0] else -(PORT // 2)), end[1]


def _end_on_border(end: tuple[int, int], before: tuple[int, int], box: Box) -> tuple[int, int]:
    """End of a line on the outline of a pseudostate."""
    if box.node.kind not in PSEUDO_STATES:
        return end
    x, y, wide, _ = box.core
    radius = wide // 2
    middle_x, middle_y = x + radius, y + radius
    upright = end[0] == before[0]
    off = abs(end[0] - middle_x) if upright else abs(end[1] - middle_y)
    if box.node.kind == "choice":
        reach = radius - off
    else:
        reach = round(sqrt(max(0, radius * radius - off * off)))
    if upright:
        return end[0], middle_y + (reach if before[1] > middle_y else -reach)
    return middle_x + (reach if before[0] > middle_x else -reach), end[1]
