"""Layout of nested containers, from the inside out.

An edge into or out of a container is split at each border that it crosses. The inner layout
determines the crossing position, which is fixed for the outer one. The side is chosen first, from
the backward edges of the outer container. This follows Sander 1996 and ELK.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from swarmdsl.codegen.diagram.graph import Diagram, Node
from swarmdsl.tools.diagram.layout.border import Border
from swarmdsl.tools.diagram.layout.cell_sides import END_GAP
from swarmdsl.tools.diagram.layout.container_layout import ContainerLayout, along_across
from swarmdsl.tools.diagram.layout.coordinates import LABEL_GAP
from swarmdsl.tools.diagram.layout.edge_routes import EdgeRoutes, Route
from swarmdsl.tools.diagram.layout.layered import layered
from swarmdsl.tools.diagram.layout.layered_graph import Cell, Link, Placement, Point, Side
from swarmdsl.tools.diagram.layout.loops import Loop, loop_room
from swarmdsl.tools.diagram.layout.regions import place_regions, stretch_regions
from swarmdsl.tools.diagram.measure import width
from swarmdsl.tools.diagram.shapes import (
    PORT,
    PSEUDO_STATES,
    Direction,
    Shape,
    port_text,
    resized,
    shape_of,
    with_indent,
)
from swarmdsl.tools.diagram.text_blocks import Block, label_block

PADDING = 18
_REGION_PADDING = 14
_SIDES: tuple[Side, ...] = ("first", "last")
_FROM_RULE, _FROM_ARROW = 5, 12
"""Distance of the end of an edge from a line, and from an arrow head inside."""
_PORT_LINE = 16
"""Space above and below the line to a port at the border; its name is above."""


class Compound:
    """Layouts of all containers of a diagram, each in its direction."""

    def __init__(
        self, diagram: Diagram, edge_routes: EdgeRoutes, directions: Mapping[str, Direction]
    ) -> None:
        self.diagram = diagram
        self.directions = directions
        self.edge_routes = edge_routes
        self.labels: dict[int, Block] = {
            number: label_block(edge.label)
            for number, edge in enumerate(diagram.edges)
            if edge.label
        }
        self.layouts: dict[str, ContainerLayout] = {}
        self._lay_out(diagram.frame, directions[diagram.frame.id], 0)

    def _lay_out(self, node: Node, around: Direction, title: int) -> None:
        """Lay out the children of a node and then the node.

        `around` is the direction of the layout that it is in, and `title` its minimum width.
        """
        shape = shape_of(node, around, self.edge_routes.right_ports)
        first_title = max(title, shape.width) if node.kind == "parallel" else 0
        for at, child in enumerate(node.nodes):
            self._lay_out(child, self.directions[node.id], 0 if at else first_title)
        if node.nodes or node.kind == "frame":
            inside = self._container(node, shape, around, max(title, shape.width))
        else:
            inside = self._leaf(node, shape, around)
        loops = self._loop_room(node, inside.width, inside.height, around)
        _, _, inside.loops, inside.own_loops = loops
        self.layouts[node.id] = inside

    def _loop_room(
        self, node: Node, wide: int, high: int, around: Direction
    ) -> tuple[int, int, int, list[Loop]]:
        loops = [(number, self.labels.get(number)) for number in self.edge_routes.loops[node.id]]
        return loop_room(loops, wide, high, around)

    def _leaf(self, node: Node, shape: Shape, around: Direction) -> ContainerLayout:
        if node.kind in PSEUDO_STATES or node.ports:
            return ContainerLayout(shape, shape.width, shape.height, around)
        length, breadth = along_across(around, shape.width, shape.height)
        breadth = max(breadth, *(self._room_for_ends(node, side, around) for side in _SIDES))
        wide, high = along_across(around, length, breadth)
        wide, high, _, _ = self._loop_room(node, wide, high, around)
        return ContainerLayout(resized(shape, wide, high), wide, high, around)

    def _room_for_ends(self, node: Node, side: Side, around: Direction) -> int:
        """Extent of a side with all its ends; labels beside each other fit beside the node."""
        rooms = []
        for number, starts in self.edge_routes.ends[node.id, side]:
            label = self.labels.get(number) if starts and around == "right" else None
            rooms.append(label.height + 3 + LABEL_GAP if label is not None else END_GAP + 4)
        return 2 * END_GAP + sum(rooms[1:])

    def _container(
        self, node: Node, shape: Shape, around: Direction, title: int
    ) -> ContainerLayout:
        """Lay out the children of a container and add its header and padding."""
        direction = self.directions[node.id]
        cells = [self._cell(child, direction) for child in node.nodes]
        index = {child.id: at for at, child in enumerate(node.nodes)}
        borders: dict[tuple[int, Side], int] = {}
        ports: dict[str, int] = {}
        for port in node.ports:
            ports[port.id] = len(cells)
            at_border: Side = "last" if port.id in self.edge_routes.right_ports else "first"
            length = width(port_text(port), "line") + PORT + 8
            cells.append(Cell(length, 2 * _PORT_LINE, _PORT_LINE, _PORT_LINE, at_border))
        links: list[Link] = []
        numbers: list[int] = []
        for number, leg in self.edge_routes.inner[node.id]:
            route = self.edge_routes.routes[number]
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
            links.append(self._link(route, number, leg, ends[0], ends[1], cells, direction))
            numbers.append(number)
        # Regions fill their state unless an edge runs between them.
        beside = node.kind == "parallel" and all(
            leg != self.edge_routes.routes[number].main
            for number, leg in self.edge_routes.inner[node.id]
        )
        border = Border(node.id, self.edge_routes, borders, direction != around)
        if border.passes_header() and direction == "down" and not beside:
            # Edges that enter at the top pass to the right of the name.
            links, cells = _with_title(links, cells, title)
            shift = 1
        else:
            shift = 0
        pitch, before = (5, False) if direction == "down" else (3, True)
        if beside:
            placement = place_regions(cells, links)
        else:
            in_row = self.diagram.kind == "composition"
            placement = layered(cells, links, pitch, before, in_row)
        placement.cells = placement.cells[shift:]
        return self._wrap(node, shape, around, title, placement, numbers, border, ports, beside)

    def _cell(self, child: Node, direction: Direction) -> Cell:
        inside = self.layouts[child.id]
        length, breadth = along_across(direction, inside.width, inside.height)
        if child.nodes:
            low, high = 0, breadth
        else:
            x, y, wide, tall = inside.shape.core
            low = along_across(direction, x, y)[1]
            high = low + along_across(direction, wide, tall)[1]
        if child.kind in PSEUDO_STATES:
            # Separate the edges of a pseudostate slightly.
            reach = 0 if child.kind == "initial" else (high - low) // 2 - 3
            low, high = (low + high) // 2 - reach, (low + high) // 2 + reach
        barred = tuple(self._barred(child, inside, direction))
        return Cell(length, breadth + inside.loops, low, high, barred=barred)

    def _barred(
        self, child: Node, inside: ContainerLayout, direction: Direction
    ) -> Iterator[tuple[int, int, Side | None]]:
        """Parts of the sides of a node in which an edge would continue a line inside."""
        if direction == "right":
            rules = [*inside.shape.block.rules, *[inside.shape.block.height] * bool(child.nodes)]
            for rule in rules:
                yield rule - _FROM_RULE, rule + _FROM_RULE, None
        for at, side in inside.arrows:
            yield at - _FROM_ARROW, at + _FROM_ARROW, side

    def _link(
        self,
        route: Route,
        number: int,
        leg: int,
        source: int,
        target: int,
        cells: list[Cell],
        direction: Direction,
    ) -> Link:
        _, source_id, target_id = route.legs[leg]
        edge = route.edge
        link = Link(source, target, route.flipped)
        if cells[source].border is not None or cells[target].border is not None:
            link.flipped = cells[source].border == "last" or cells[target].border == "first"
        link.source_at = self._crossing(source_id, number, leg > 0, edge.source_port, direction)
        last = len(route.legs) - 1
        link.target_at = self._crossing(target_id, number, leg < last, edge.target_port, direction)
        if edge.source_port is not None and source_id is not None:
            link.source_side = (
                "last" if edge.source_port in self.edge_routes.right_ports else "first"
            )
        if edge.target_port is not None and target_id is not None:
            link.target_side = (
                "last" if edge.target_port in self.edge_routes.right_ports else "first"
            )
        block = self.labels.get(number)
        # The label is beside the source, inside the container that the edge may leave.
        if block is not None and leg == route.labelled:
            link.label = along_across(direction, block.width, block.height)
        if leg == route.labelled and (block is not None or edge.kind == "association"):
            link.min_layers = 2
        return link

    def _crossing(
        self, node: str | None, number: int, crosses: bool, port: str | None, direction: Direction
    ) -> int | None:
        """Position at which an edge must end on a node: a border crossing or a port."""
        if node is None:
            return None
        inside = self.layouts[node]
        if port is not None:
            return next(
                along_across(direction, x, y)[1] for id_, x, y in inside.shape.ports if id_ == port
            )
        return inside.crossings[number] if crosses else None

    def _wrap(
        self,
        node: Node,
        shape: Shape,
        around: Direction,
        title: int,
        placement: Placement,
        numbers: list[int],
        border: Border,
        ports: dict[str, int],
        beside: bool,
    ) -> ContainerLayout:
        """Put a layout into the box of its container."""
        direction = self.directions[node.id]
        head = shape.block.height
        pad = 0 if beside else PADDING
        if node.kind == "region":
            pad = _REGION_PADDING
        down = direction == "down"
        before_along, before_across = (head + pad, pad) if down else (pad, head + pad)
        sides = {"last" if port in self.edge_routes.right_ports else "first" for port in ports}
        if "first" in sides:
            before_along = 0
        border.place(placement, before_along, before_across)
        room_first, room_last = border.room("first"), border.room("last")
        if room_first and not down:
            shape = with_indent(shape, room_first)
            title += room_first
        before_along += room_first
        length = before_along + placement.length + room_last + (0 if "last" in sides else pad)
        breadth = before_across + placement.breadth + pad
        least = self._loop_room(node, title, head, around)
        least_length, least_breadth = along_across(direction, least[0], least[1])
        length, breadth = max(length, least_length), max(breadth, least_breadth)
        inside = ContainerLayout(
            shape, *along_across(direction, length, breadth), direction, regions=beside
        )

        def moved(point: Point) -> Point:
            return point[0] + before_along, point[1] + before_across

        def shown(point: Point) -> Point:
            return along_across(direction, *point)

        for child, place in zip(node.nodes, placement.cells, strict=False):
            inside.children[child.id] = shown(moved(place))
        if beside:
            regions = {child.id: self.layouts[child.id] for child in node.nodes}
            stretch_regions(inside, regions, length - before_along, self.edge_routes)
        for number, way, label in zip(numbers, placement.routes, placement.labels, strict=True):
            points = [moved(point) for point in way]
            if beside and (number, "last") in border.cells:
                # Regions extend to the end.
                points = [(length, points[0][1])]
            border.extend(number, points, length, breadth)
            for at, port_id in (
                (0, self.edge_routes.routes[number].edge.source_port),
                (-1, self.edge_routes.routes[number].edge.target_port),
            ):
                if port_id in ports:
                    points[at] = (
                        length if port_id in self.edge_routes.right_ports else 0,
                        points[at][1],
                    )
            inside.segments_of[number] = [shown(point) for point in points]
            if label is not None:
                inside.labels[number] = shown(moved(label))
        inside.crossings = border.crossings(length)
        if direction == around:
            inside.arrows = border.arrows()
        for port_id, cell in ports.items():
            across = moved(placement.cells[cell])[1]
            at_end = port_id in self.edge_routes.right_ports
            inside.ports[port_id] = shown((length if at_end else 0, across + _PORT_LINE))
        return inside


def _with_title(links: list[Link], cells: list[Cell], title: int) -> tuple[list[Link], list[Cell]]:
    """Reserve space for a title in the first layer."""
    for link in links:
        link.source += 1
        link.target += 1
    return links, [Cell(0, title - PADDING, 0, 0, title=True), *cells]
