"""Layouts of nodes in nodes, from the inside out.

An edge into a container or out of it is cut at each border that it crosses. The inner layout
says where across it crosses, and the outer one takes that as given; at which side it does is
decided before, by which edges point backwards in the outer one. So Sander 1996, and ELK, do it.
"""

from __future__ import annotations

from swarmdsl.codegen.diagram.graph import Diagram, Node
from swarmdsl.tools.diagram.content import Block, label_block
from swarmdsl.tools.diagram.layout.inside import Inside
from swarmdsl.tools.diagram.layout.layered import layered
from swarmdsl.tools.diagram.layout.level import Cell, Link, Placement, Point, Side
from swarmdsl.tools.diagram.layout.loops import Loop, loop_room
from swarmdsl.tools.diagram.layout.passages import Passages, Route
from swarmdsl.tools.diagram.layout.placing import END_GAP
from swarmdsl.tools.diagram.layout.regions import put_beside, stretch
from swarmdsl.tools.diagram.measure import width
from swarmdsl.tools.diagram.shapes import (
    PORT,
    PSEUDO_STATES,
    Direction,
    Shape,
    port_text,
    resized,
    shape_of,
)

PADDING = 18
_REGION_PADDING = 14
_PORT_LINE = 16
"""Above and below the line to a port at the border, above which is its name."""


class Compound:
    """The layouts of all containers of a diagram."""

    def __init__(self, diagram: Diagram, direction: Direction) -> None:
        self.diagram = diagram
        self.direction = direction
        self.passages = Passages(diagram)
        self.labels: dict[int, Block] = {
            number: label_block(edge.label)
            for number, edge in enumerate(diagram.edges)
            if edge.label
        }
        self.inside: dict[str, Inside] = {}
        self._lay_out(diagram.frame, 0)

    def _along(self, wide: int, high: int) -> tuple[int, int]:
        """A size along and across, or coordinates."""
        return (high, wide) if self.direction == "down" else (wide, high)

    def _lay_out(self, node: Node, title: int) -> None:
        """Lay out a node, and what is in it first; `title` is the least room for its name."""
        shape = shape_of(node, self.direction, self.passages.right_ports)
        first_title = max(title, shape.width) if node.kind == "parallel" else 0
        for at, child in enumerate(node.nodes):
            self._lay_out(child, 0 if at else first_title)
        if node.nodes or node.kind == "frame":
            inside = self._container(node, shape, max(title, shape.width))
        else:
            inside = self._leaf(node, shape)
        wide, high = self._along(inside.length, inside.breadth)
        _, _, inside.loops, inside.own_loops = self._loop_room(node, wide, high)
        self.inside[node.id] = inside

    def _loop_room(self, node: Node, wide: int, high: int) -> tuple[int, int, int, list[Loop]]:
        loops = [(number, self.labels.get(number)) for number in self.passages.loops[node.id]]
        return loop_room(loops, wide, high, self.direction)

    def _leaf(self, node: Node, shape: Shape) -> Inside:
        if node.kind in PSEUDO_STATES or node.ports:
            return Inside(shape, *self._along(shape.width, shape.height))
        ends = max(self.passages.ends[node.id, "first"], self.passages.ends[node.id, "last"])
        length, breadth = self._along(shape.width, shape.height)
        wide, high = self._along(length, max(breadth, 2 * END_GAP + (ends - 1) * (END_GAP + 4)))
        wide, high, _, _ = self._loop_room(node, wide, high)
        return Inside(resized(shape, wide, high), *self._along(wide, high))

    def _container(self, node: Node, shape: Shape, title: int) -> Inside:
        """Lay out what is in a container, and put the head and room around it."""
        cells = [self._cell(child) for child in node.nodes]
        index = {child.id: at for at, child in enumerate(node.nodes)}
        borders: dict[tuple[int, Side], int] = {}
        ports: dict[str, int] = {}
        for port in node.ports:
            ports[port.id] = len(cells)
            at_border: Side = "last" if port.id in self.passages.right_ports else "first"
            length = width(port_text(port), "line") + PORT + 8
            cells.append(Cell(length, 2 * _PORT_LINE, _PORT_LINE, _PORT_LINE, at_border))
        links: list[Link] = []
        numbers: list[int] = []
        for number, leg in self.passages.inner[node.id]:
            route = self.passages.routes[number]
            _, source, target = route.legs[leg]
            ends: list[int] = []
            for end, port_id, side in (
                (source, route.edge.source_port, route.entry(leg)),
                (target, route.edge.target_port, route.exit(leg)),
            ):
                if end is not None:
                    ends.append(index[end])
                elif port_id is not None:
                    ends.append(ports[port_id])
                else:
                    borders[number, side] = len(cells)
                    ends.append(len(cells))
                    cells.append(Cell(0, 0, 0, 0, side))
            links.append(self._link(route, number, leg, ends[0], ends[1], cells))
            numbers.append(number)
        # Regions fill their state unless an edge has to be drawn between them.
        beside = node.kind == "parallel" and all(
            leg != self.passages.routes[number].main for number, leg in self.passages.inner[node.id]
        )
        entered = any(side == "first" for _, side in borders)
        if entered and self.direction == "down" and not beside:
            # Edges that come in at the top pass the name at its right.
            links, cells = _with_title(links, cells, title)
            shift = 1
        else:
            shift = 0
        pitch, before = (5, False) if self.direction == "down" else (3, True)
        if beside:
            placement = put_beside(cells, links)
        else:
            in_row = self.diagram.kind == "composition"
            placement = layered(cells, links, pitch, before, in_row)
        return self._wrap(node, shape, title, placement, shift, numbers, borders, ports, beside)

    def _cell(self, child: Node) -> Cell:
        inside = self.inside[child.id]
        if child.nodes:
            low, high = 0, inside.breadth
        else:
            x, y, wide, tall = inside.shape.core
            low = self._along(x, y)[1]
            high = low + self._along(wide, tall)[1]
        if child.kind in PSEUDO_STATES:
            # Several edges of one that is passed through are a little apart.
            reach = 0 if child.kind in ("initial", "final") else (high - low) // 2 - 3
            low, high = (low + high) // 2 - reach, (low + high) // 2 + reach
        return Cell(inside.length, inside.breadth + inside.loops, low, high)

    def _link(
        self, route: Route, number: int, leg: int, source: int, target: int, cells: list[Cell]
    ) -> Link:
        _, source_id, target_id = route.legs[leg]
        edge = route.edge
        link = Link(source, target, route.flipped)
        if cells[source].border is not None or cells[target].border is not None:
            link.flipped = cells[source].border == "last" or cells[target].border == "first"
        link.source_at = self._crossing(source_id, number, leg > 0, edge.source_port)
        last = len(route.legs) - 1
        link.target_at = self._crossing(target_id, number, leg < last, edge.target_port)
        if edge.source_port is not None and source_id is not None:
            link.source_side = "last" if edge.source_port in self.passages.right_ports else "first"
        if edge.target_port is not None and target_id is not None:
            link.target_side = "last" if edge.target_port in self.passages.right_ports else "first"
        block = self.labels.get(number)
        if block is not None and leg == route.main:
            link.label = self._along(block.width, block.height)
        if leg == route.main and (block is not None or edge.kind == "association"):
            link.least = 2
        return link

    def _crossing(
        self, node: str | None, number: int, crosses: bool, port: str | None
    ) -> int | None:
        """Where an edge must end on a node: where it crosses its border, or at its port."""
        if node is None:
            return None
        inside = self.inside[node]
        if port is not None:
            return next(self._along(x, y)[1] for id_, x, y in inside.shape.ports if id_ == port)
        return inside.crossings[number] if crosses else None

    def _wrap(
        self,
        node: Node,
        shape: Shape,
        title: int,
        placement: Placement,
        shift: int,
        numbers: list[int],
        borders: dict[tuple[int, Side], int],
        ports: dict[str, int],
        beside: bool,
    ) -> Inside:
        """Put a layout in its box."""
        head = shape.block.height
        pad = 0 if beside else PADDING
        down = self.direction == "down"
        if node.kind == "region":
            pad = _REGION_PADDING
        before_along, before_across = (head + pad, pad) if down else (pad, head + pad)
        sides = {"last" if port in self.passages.right_ports else "first" for port in ports}
        if "first" in sides:
            before_along = 0
        length = before_along + placement.length + (0 if "last" in sides else pad)
        breadth = before_across + placement.breadth + pad
        least = self._loop_room(node, title, head)
        least_length, least_breadth = self._along(least[0], least[1])
        length, breadth = max(length, least_length), max(breadth, least_breadth)
        inside = Inside(shape, length, breadth, regions=beside)

        def moved(point: Point) -> Point:
            return point[0] + before_along, point[1] + before_across

        for at, child in enumerate(node.nodes):
            inside.children[child.id] = moved(placement.cells[at + shift])
        if beside:
            regions = {child.id: self.inside[child.id] for child in node.nodes}
            stretch(inside, regions, inside.length - before_along, self.passages)
        for key, cell in borders.items():
            across = placement.cells[cell + shift][1] + before_across
            inside.crossings[key[0]] = across
        for number, way, label in zip(numbers, placement.routes, placement.labels, strict=True):
            points = [moved(point) for point in way]
            if beside and (number, "last") in borders:
                # Regions reach to the end.
                points = [(length, points[0][1])]
            # It goes on to the border, through the head and the room around.
            if (number, "first") in borders or (number, "last") in borders:
                route = self.passages.routes[number]
                leg = next(at for at, each in enumerate(route.legs) if each[0] == node.id)
                _, source, target = route.legs[leg]
                if source is None:
                    first = (number, "first") in borders
                    points.insert(0, (0 if first else length, points[0][1]))
                if target is None:
                    first = (number, "first") in borders
                    points.append((0 if first else length, points[-1][1]))
            for at, port_id in (
                (0, self.passages.routes[number].edge.source_port),
                (-1, self.passages.routes[number].edge.target_port),
            ):
                if port_id in ports:
                    points[at] = (
                        length if port_id in self.passages.right_ports else 0,
                        points[at][1],
                    )
            inside.pieces[number] = points
            if label is not None:
                inside.labels[number] = moved(label)
        for port_id, cell in ports.items():
            across = moved(placement.cells[cell])[1]
            at_end = port_id in self.passages.right_ports
            inside.ports[port_id] = (length if at_end else 0, across + _PORT_LINE)
        return inside


def _with_title(links: list[Link], cells: list[Cell], title: int) -> tuple[list[Link], list[Cell]]:
    """The same with room for a name in the first layer."""
    for link in links:
        link.source += 1
        link.target += 1
    return links, [Cell(0, title - PADDING, 0, 0, title=True), *cells]
