"""Layout of nested containers, from the inside out.

An edge into or out of a container is split at each border that it crosses. The inner layout
determines the crossing position, which is fixed for the outer one. The side is chosen first, from
the backward edges of the outer container. This follows Sander 1996 and ELK.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from swarmdsl.codegen.diagram.graph import Diagram, Node
from swarmdsl.tools.diagram.layout.cell_sides import END_GAP
from swarmdsl.tools.diagram.layout.chains import LABEL_GAP
from swarmdsl.tools.diagram.layout.container_layout import ContainerLayout, along_across
from swarmdsl.tools.diagram.layout.edge_routes import EdgeRoutes
from swarmdsl.tools.diagram.layout.layered import layered
from swarmdsl.tools.diagram.layout.layered_graph import Cell, Link, Placement, Point, Side
from swarmdsl.tools.diagram.layout.level import PORT_LINE, Level
from swarmdsl.tools.diagram.layout.level_orders import order_levels
from swarmdsl.tools.diagram.layout.loops import Loop, loop_room
from swarmdsl.tools.diagram.layout.regions import place_regions, stretch_regions
from swarmdsl.tools.diagram.layout.texts import Texts
from swarmdsl.tools.diagram.shapes import (
    PSEUDO_STATES,
    Direction,
    Shape,
    resized,
    with_indent,
)

PADDING = 18
_REGION_PADDING = 14
_SIDES: tuple[Side, ...] = ("first", "last")
_FROM_RULE, _FROM_ARROW = 5, 12
"""Distance of the end of an edge from a line, and from an arrow head inside."""


class Compound:
    """Layouts of all containers of a diagram, each in its direction and number of rows."""

    def __init__(
        self,
        diagram: Diagram,
        edge_routes: EdgeRoutes,
        texts: Texts,
        directions: Mapping[str, Direction],
        rows: Mapping[str, int],
    ) -> None:
        self.diagram = diagram
        self.directions = directions
        self.rows = rows
        self.edge_routes = edge_routes
        self.texts = texts
        self.labels = texts.labels
        self.layouts: dict[str, ContainerLayout] = {}
        self.levels: dict[str, Level] = {}
        self._make_levels(diagram.frame, directions[diagram.frame.id])
        order_levels(diagram.frame, self.levels)
        self._lay_out(diagram.frame, directions[diagram.frame.id], 0)

    def _make_levels(self, node: Node, around: Direction) -> None:
        """Make the layered graphs of all containers; `around` is the direction outside."""
        if node.nodes or node.kind == "frame":
            direction = self.directions[node.id]
            self.levels[node.id] = Level(node, direction, around, self.edge_routes, self.labels)
            for child in node.nodes:
                self._make_levels(child, direction)

    def _lay_out(self, node: Node, around: Direction, title: int) -> None:
        """Lay out the children of a node and then the node.

        `around` is the direction of the layout that it is in, and `title` its minimum width.
        """
        shape = self.texts.shape(node, around)
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
        level = self.levels[node.id]
        for at, child in enumerate(node.nodes):
            self._size(level.cells[level.cell_of(at)], child, level.direction)
        if level.titled:
            level.cells[0].breadth = title - PADDING
        for number, link in zip(level.numbers, level.links, strict=True):
            self._fix_ends(level, number, link)
        if level.beside:
            placement = place_regions(level.cells, level.links)
        else:
            level.place_ends()
            placement = layered(
                level, self.diagram.kind == "composition", self.rows.get(level.node.id, 1)
            )
        placement.cells = placement.cells[level.titled :]
        return self._wrap(level, shape, around, title, placement)

    def _size(self, cell: Cell, child: Node, direction: Direction) -> None:
        """Give a cell the size of its node."""
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
        cell.length, cell.breadth = length, breadth + inside.loops
        cell.low, cell.high = low, high
        cell.barred = tuple(self._barred(child, inside, direction))

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

    def _fix_ends(self, level: Level, number: int, link: Link) -> None:
        """Set the positions at which a link must end."""
        route = self.edge_routes.routes[number]
        leg = next(at for at, each in enumerate(route.legs) if each[0] == level.node.id)
        _, source, target = route.legs[leg]
        edge, way = route.edge, level.direction
        last = len(route.legs) - 1
        crosses = self.edge_routes.crosses
        link.source_at = self._crossing(
            source,
            number,
            source is not None and crosses(source, number, leg == 0),
            edge.source_port,
            way,
        )
        link.target_at = self._crossing(
            target,
            number,
            target is not None and crosses(target, number, leg == last),
            edge.target_port,
            way,
        )

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
        self, level: Level, shape: Shape, around: Direction, title: int, placement: Placement
    ) -> ContainerLayout:
        """Put a layout into the box of its container."""
        node, direction, border = level.node, level.direction, level.border
        ports, beside = level.ports, level.beside
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
        for number, way, label in zip(
            level.numbers, placement.routes, placement.labels, strict=True
        ):
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
            inside.ports[port_id] = shown((length if at_end else 0, across + PORT_LINE))
        return inside
