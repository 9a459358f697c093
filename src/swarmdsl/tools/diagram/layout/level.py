"""Layered graph of one container, made before the sizes of its nodes are known."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from swarmdsl.codegen.diagram.graph import Node
from swarmdsl.tools.diagram.layout.border import Border
from swarmdsl.tools.diagram.layout.container_layout import along_across
from swarmdsl.tools.diagram.layout.edge_routes import EdgeRoutes, Route
from swarmdsl.tools.diagram.layout.layered_graph import Cell, End, Link, Side
from swarmdsl.tools.diagram.layout.layering import make_layers
from swarmdsl.tools.diagram.layout.ordering import Ordering
from swarmdsl.tools.diagram.measure import width
from swarmdsl.tools.diagram.shapes import PORT, Direction, port_text
from swarmdsl.tools.diagram.text_blocks import Block

PORT_LINE = 16
"""Space above and below the line to a port at the border; its name is above."""


class Level:
    """Nodes of a container as cells, and edges as links, with `numbers` in the diagram.

    After the cells of the children, there is one for each port of the container, and one for each
    edge that ends at the border or crosses it. With `titled`, a cell before all others reserves
    space for the title. Regions that fill their state, `beside` each other, have no layers.
    """

    def __init__(
        self,
        node: Node,
        direction: Direction,
        around: Direction,
        routes: EdgeRoutes,
        labels: Mapping[int, Block],
    ) -> None:
        self.node = node
        self.direction = direction
        self.routes = routes
        self.pitch, self.label_before = (5, False) if direction == "down" else (3, True)
        self.cells = [Cell(0, 0, 0, 0) for _ in node.nodes]
        self.ports: dict[str, int] = {}
        for port in node.ports:
            self.ports[port.id] = len(self.cells)
            at_border: Side = "last" if port.id in routes.right_ports else "first"
            length = width(port_text(port), "line") + PORT + 8
            self.cells.append(Cell(length, 2 * PORT_LINE, PORT_LINE, PORT_LINE, at_border))
        self.links: list[Link] = []
        self.numbers: list[int] = []
        borders = self._add_links(labels)
        # Regions fill their state unless an edge runs between them.
        self.beside = node.kind == "parallel" and all(
            leg != routes.routes[number].main for number, leg in routes.inner[node.id]
        )
        self.border = Border(node.id, routes, borders, direction != around)
        # Edges that enter at the top pass to the right of the name.
        self.titled = self.border.passes_header() and direction == "down" and not self.beside
        if self.titled:
            for link in self.links:
                link.source += 1
                link.target += 1
            self.cells.insert(0, Cell(0, 0, 0, 0, title=True))
        self.layers = make_layers([] if self.beside else self.cells, self._layered(), self.pitch)
        # Reserved places are no vertices before the order is known.
        self.reserved = {
            number: self.layers.cells[cell + self.titled]
            for (number, _), cell in borders.items()
            if not self.beside and number in routes.reserved.get(node.id, {})
        }
        left_out = {id(vertex) for vertex in self.reserved.values()}
        for layer in self.layers.layers if left_out else ():
            layer[:] = [vertex for vertex in layer if id(vertex) not in left_out]
        self.ordering = Ordering(self.layers)
        self.outer_ends = self._outer_ends()

    def _layered(self) -> list[Link]:
        return [] if self.beside else self.links

    def _add_links(self, labels: Mapping[int, Block]) -> dict[tuple[int, Side], int]:
        """Add all links; return the cells of edges at the border."""
        index = {child.id: at for at, child in enumerate(self.node.nodes)}
        borders: dict[tuple[int, Side], int] = {}
        for number, leg in self.routes.inner[self.node.id]:
            route = self.routes.routes[number]
            _, source, target = route.legs[leg]
            ends: list[int] = []
            for end, port_id, side in (
                (source, route.edge.source_port, route.entry(leg)),
                (target, route.edge.target_port, route.exit(leg)),
            ):
                if end is not None:
                    ends.append(index[end])
                elif port_id is not None:
                    ends.append(self.ports[port_id])
                else:
                    borders[number, side] = len(self.cells)
                    ends.append(len(self.cells))
                    self.cells.append(Cell(0, 0, 0, 0, side))
            self.links.append(self._link(route, leg, ends[0], ends[1], labels.get(number)))
            self.numbers.append(number)
        for number, side in self.routes.reserved.get(self.node.id, {}).items():
            borders[number, side] = len(self.cells)
            self.cells.append(Cell(0, 0, 0, 0, side))
        return borders

    def _link(self, route: Route, leg: int, source: int, target: int, label: Block | None) -> Link:
        edge = route.edge
        link = Link(source, target, route.flipped)
        if self.cells[source].border is not None or self.cells[target].border is not None:
            link.flipped = (
                self.cells[source].border == "last" or self.cells[target].border == "first"
            )
        _, source_id, target_id = route.legs[leg]
        right = self.routes.right_ports
        if edge.source_port is not None and source_id is not None:
            link.source_side = "last" if edge.source_port in right else "first"
        if edge.target_port is not None and target_id is not None:
            link.target_side = "last" if edge.target_port in right else "first"
        # The label is beside the source, inside the container that the edge may leave.
        if label is not None and leg == route.labelled:
            link.label = along_across(self.direction, label.width, label.height)
        if leg == route.labelled and (label is not None or edge.kind == "association"):
            link.min_layers = 2
        return link

    def cell_of(self, child: int) -> int:
        """Index of the cell of a child."""
        return child + self.titled

    def crossing_ends(self) -> list[tuple[int, str, End, End]]:
        """Return the ends at children whose borders edges cross, except at regions beside.

        Each is an edge, the child, and the end there with the other end of its segment.
        """
        found: list[tuple[int, str, End, End]] = []
        if self.beside:
            return found
        firsts, lasts = self.outer_ends
        for link, number in enumerate(self.numbers):
            route = self.routes.routes[number]
            leg = next(at for at, each in enumerate(route.legs) if each[0] == self.node.id)
            _, source, target = route.legs[leg]
            if source is not None and leg > 0:
                found.append((number, source, *firsts[link]))
            if target is not None and leg < len(route.legs) - 1:
                found.append((number, target, *lasts[link]))
        return found

    def _outer_ends(self) -> tuple[dict[int, tuple[End, End]], dict[int, tuple[End, End]]]:
        """First and last ends of each link, with the other ends of their segments."""
        firsts: dict[int, tuple[End, End]] = {}
        lasts: dict[int, tuple[End, End]] = {}
        for segment in self.layers.segments:
            firsts.setdefault(segment.link, (segment.start, segment.end))
            lasts[segment.link] = segment.end, segment.start
        return firsts, lasts

    def other_ends(self, child: str, numbers: Collection[int]) -> dict[int, End]:
        """Return the other ends of the segments at a child, of edges with these numbers."""
        firsts, lasts = self.outer_ends
        at = self.cell_of(next(at for at, each in enumerate(self.node.nodes) if each.id == child))
        found = {}
        for link, number in enumerate(self.numbers):
            if number in numbers and link in firsts:
                is_source = self.links[link].source == at
                found[number] = (firsts if is_source else lasts)[link][1]
        return found

    def place_ends(self) -> None:
        """Take the sizes of cells, and the positions at which links must end, into the layers."""
        for vertex in self.layers.cells:
            cell = self.cells[vertex.cell or 0]
            vertex.length, vertex.breadth = cell.length, cell.breadth
        firsts, lasts = self.outer_ends
        for at, link in enumerate(self._layered()):
            firsts[at][0].at, lasts[at][0].at = link.source_at, link.target_at
