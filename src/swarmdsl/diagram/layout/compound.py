"""Layouts of nodes in nodes, from the inside out.

An edge into a container or out of it is cut at each border that it crosses. The inner layout
says where across it crosses, and the outer one takes that as given; at which side it does is
decided before, by which edges point backwards in the outer one. So Sander 1996, and ELK, do it.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field

from swarmdsl.diagram.content import Block, label_block
from swarmdsl.diagram.graph import Diagram, Edge, Node
from swarmdsl.diagram.layout.cycles import backward
from swarmdsl.diagram.layout.layered import layered
from swarmdsl.diagram.layout.level import Cell, Link, Placement, Point, Side
from swarmdsl.diagram.layout.loops import Loop, loop_room
from swarmdsl.diagram.layout.placing import END_GAP
from swarmdsl.diagram.measure import width
from swarmdsl.diagram.shapes import (
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


@dataclass
class Inside:
    """The layout of one container, and of a node without anything inside.

    Sizes are along and across; `loops` is how far loops reach beyond the box, across.
    `crossings` are where edges cross the border, by their number and side; `pieces` the parts
    of edges inside, `labels` the corners of their labels, from the corner of the box. The nodes
    inside are `regions` if they fill it.
    """

    shape: Shape
    length: int
    breadth: int
    loops: int = 0
    children: dict[str, Point] = field(default_factory=dict)
    crossings: dict[int, int] = field(default_factory=dict)
    pieces: dict[int, list[Point]] = field(default_factory=dict)
    labels: dict[int, Point] = field(default_factory=dict)
    own_loops: list[Loop] = field(default_factory=list)
    ports: dict[str, Point] = field(default_factory=dict)
    regions: bool = False


@dataclass
class _Route:
    """How an edge goes: the containers that it leaves, the one it is in, those it enters.

    Each container comes with the nodes in it between which the edge goes, None for its border.
    """

    edge: Edge
    legs: list[tuple[str, str | None, str | None]]
    main: int
    flipped: bool = False

    def entry(self, leg: int) -> Side:
        """The side on which it comes in; from the container itself, as from before."""
        return "last" if self.flipped and leg != self.main else "first"

    def exit(self, leg: int) -> Side:
        """The side on which it goes out; to the container itself, as to after."""
        return "first" if self.flipped and leg != self.main else "last"


class Compound:
    """The layouts of all containers of a diagram."""

    def __init__(self, diagram: Diagram, direction: Direction) -> None:
        self.diagram = diagram
        self.direction = direction
        self.nodes = {node.id: node for node in diagram.frame.walk()}
        self.parents = {child.id: node.id for node in diagram.frame.walk() for child in node.nodes}
        self.labels: dict[int, Block] = {
            number: label_block(edge.label)
            for number, edge in enumerate(diagram.edges)
            if edge.label
        }
        self.right_ports = self._right_ports()
        self.loops: dict[str, list[int]] = defaultdict(list)
        self.routes: dict[int, _Route] = {}
        self.inner: dict[str, list[tuple[int, int]]] = defaultdict(list)
        for number, edge in enumerate(diagram.edges):
            if edge.source == edge.target and edge.source_port is None:
                self.loops[edge.source].append(number)
                continue
            route = self._route(edge)
            self.routes[number] = route
            for leg, (container, _, _) in enumerate(route.legs):
                self.inner[container].append((number, leg))
        for node in diagram.frame.walk():
            self._flip(node)
        self.ends: dict[tuple[str, Side], int] = defaultdict(int)
        self._count_ends()
        self.inside: dict[str, Inside] = {}
        self._lay_out(diagram.frame, 0)

    def _right_ports(self) -> set[str]:
        """Ports from which data go out, by their direction or, if that is both, by their use."""
        sources = {edge.source_port for edge in self.diagram.edges}
        targets = {edge.target_port for edge in self.diagram.edges}
        found = set()
        for node in self.nodes.values():
            # At the border of the frame, what comes out of it is at the right as well.
            inner = (targets, sources) if node.kind == "frame" else (sources, targets)
            for port in node.ports:
                both = port.id in inner[0] and port.id not in inner[1]
                if port.direction == "out" or (port.direction == "inout" and both):
                    found.add(port.id)
        return found

    def _above(self, node: str) -> list[str]:
        """A node and the containers that it is in, to the frame."""
        found = [node]
        while found[-1] in self.parents:
            found.append(self.parents[found[-1]])
        return found

    def _route(self, edge: Edge) -> _Route:
        above_source, above_target = self._above(edge.source), self._above(edge.target)
        common = next(
            each for each in above_source if each in above_target and self.nodes[each].nodes
        )
        out = above_source[: above_source.index(common)]
        into = above_target[: above_target.index(common)]
        legs: list[tuple[str, str | None, str | None]] = [
            (self.parents[node], node, None) for node in out[:-1]
        ]
        main = len(legs)
        legs.append((common, out[-1] if out else None, into[-1] if into else None))
        legs += ((self.parents[node], None, node) for node in reversed(into[:-1]))
        return _Route(edge, legs, main)

    def _flip(self, node: Node) -> None:
        """Decide which edges in a container point backwards."""
        index = {child.id: at for at, child in enumerate(node.nodes)}
        found = []
        for number, leg in self.inner[node.id]:
            route = self.routes[number]
            _, source, target = route.legs[leg]
            if leg == route.main and source is not None and target is not None:
                found.append((route, index[source], index[target]))
        edges = [(source, target) for _, source, target in found]
        for at in backward(len(index), edges, ()):
            found[at][0].flipped = True

    def _count_ends(self) -> None:
        """Count edges on each side of each node, which has to be wide enough for them."""
        for route in self.routes.values():
            out: Side = "first" if route.flipped else "last"
            into: Side = "last" if route.flipped else "first"
            self.ends[route.edge.source, out] += 1
            self.ends[route.edge.target, into] += 1

    def _along(self, wide: int, high: int) -> tuple[int, int]:
        """A size along and across, or coordinates."""
        return (high, wide) if self.direction == "down" else (wide, high)

    def _lay_out(self, node: Node, title: int) -> None:
        """Lay out a node, and what is in it first; `title` is the least room for its name."""
        shape = shape_of(node, self.direction, self.right_ports)
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
        loops = [(number, self.labels.get(number)) for number in self.loops[node.id]]
        return loop_room(loops, wide, high, self.direction)

    def _leaf(self, node: Node, shape: Shape) -> Inside:
        if node.kind in PSEUDO_STATES or node.ports:
            return Inside(shape, *self._along(shape.width, shape.height))
        ends = max(self.ends[node.id, "first"], self.ends[node.id, "last"])
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
            at_border: Side = "last" if port.id in self.right_ports else "first"
            length = width(port_text(port), "line") + PORT + 8
            cells.append(Cell(length, 2 * _PORT_LINE, _PORT_LINE, _PORT_LINE, at_border))
        links: list[Link] = []
        numbers: list[int] = []
        for number, leg in self.inner[node.id]:
            route = self.routes[number]
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
            leg != self.routes[number].main for number, leg in self.inner[node.id]
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
            placement = _beside(cells, links)
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
        self, route: _Route, number: int, leg: int, source: int, target: int, cells: list[Cell]
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
            link.source_side = "last" if edge.source_port in self.right_ports else "first"
        if edge.target_port is not None and target_id is not None:
            link.target_side = "last" if edge.target_port in self.right_ports else "first"
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
        sides = {"last" if port in self.right_ports else "first" for port in ports}
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
            self._stretch_regions(node, inside, before_along, before_across)
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
                route = self.routes[number]
                leg = next(at for at, each in enumerate(route.legs) if each[0] == node.id)
                _, source, target = route.legs[leg]
                if source is None:
                    first = (number, "first") in borders
                    points.insert(0, (0 if first else length, points[0][1]))
                if target is None:
                    first = (number, "first") in borders
                    points.append((0 if first else length, points[-1][1]))
            for at, port_id in (
                (0, self.routes[number].edge.source_port),
                (-1, self.routes[number].edge.target_port),
            ):
                if port_id in ports:
                    points[at] = (length if port_id in self.right_ports else 0, points[at][1])
            inside.pieces[number] = points
            if label is not None:
                inside.labels[number] = moved(label)
        for port_id, cell in ports.items():
            across = moved(placement.cells[cell])[1]
            at_end = port_id in self.right_ports
            inside.ports[port_id] = (length if at_end else 0, across + _PORT_LINE)
        return inside

    def _stretch_regions(
        self, node: Node, inside: Inside, before_along: int, before_across: int
    ) -> None:
        """Make regions fill the state that they are in."""
        for child in node.nodes:
            region = self.inside[child.id]
            region.length = inside.length - before_along
            for number, points in region.pieces.items():
                route = self.routes[number]
                leg = next(at for at, each in enumerate(route.legs) if each[0] == child.id)
                _, source, target = route.legs[leg]
                if source is None and points[0][0] > 0:
                    points[0] = (region.length, points[0][1])
                if target is None and points[-1][0] > 0:
                    points[-1] = (region.length, points[-1][1])
        last = self.inside[node.nodes[-1].id]
        last.breadth = inside.breadth - inside.children[node.nodes[-1].id][1]


def _with_title(links: list[Link], cells: list[Cell], title: int) -> tuple[list[Link], list[Cell]]:
    """The same with room for a name in the first layer."""
    for link in links:
        link.source += 1
        link.target += 1
    return links, [Cell(0, title - PADDING, 0, 0, title=True), *cells]


def _beside(cells: list[Cell], links: list[Link]) -> Placement:
    """Put regions beside each other, and what crosses their borders at that of the state."""
    places: list[Point] = []
    across = 0
    inner = [cell for cell in cells if cell.border is None]
    length = max((cell.length for cell in inner), default=0)
    for cell in inner:
        places.append((0, across))
        across += cell.breadth
    places += [(0, 0)] * (len(cells) - len(inner))
    routes: list[list[Point]] = []
    for link in links:
        ends = []
        for end, at in ((link.source, link.source_at), (link.target, link.target_at)):
            if cells[end].border is None:
                ends.append((end, at if at is not None else cells[end].breadth // 2))
        (region, at) = ends[0]
        border = link.target if region == link.source else link.source
        along = 0 if cells[border].border == "first" else length
        point = (along, places[region][1] + at)
        places[border] = point
        routes.append([point])
    return Placement(length, across, places, routes, [None] * len(links))
