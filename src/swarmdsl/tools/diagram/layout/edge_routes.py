"""Routes of edges through containers, before any coordinates are known."""

from __future__ import annotations

from collections import defaultdict

from swarmdsl.base.records import dataclass
from swarmdsl.codegen.diagram.graph import Diagram, Edge, Node
from swarmdsl.tools.diagram.layout.cycles import feedback_edges
from swarmdsl.tools.diagram.layout.layered_graph import Side


@dataclass
class Route:
    """Containers on the route of an edge: those left, the common one, those entered.

    Each leg is a container with the two nodes in it that the edge connects, None for the border.
    The label is on leg `labelled`, the first one that can have it.
    """

    edge: Edge
    legs: list[tuple[str, str | None, str | None]]
    main: int
    labelled: int
    flipped: bool = False

    def entry(self, leg: int) -> Side:
        """Side on which the edge enters; edges from the container itself come from before."""
        return "last" if self.flipped and leg != self.main else "first"

    def exit(self, leg: int) -> Side:
        """Side on which the edge leaves; edges to the container itself go to after."""
        return "first" if self.flipped and leg != self.main else "last"


class EdgeRoutes:
    """Routes of all edges by number, and derived tables.

    `inner` lists the edges that cross a container, with the leg of their route; `loops` the
    self-loops of a node; `ends` the edges on a side of a node, True for those that start there;
    `right_ports` the ports on the right side of their box; `reserved` the edges that end at a
    container and have a place on a side that other edges cross.
    """

    def __init__(self, diagram: Diagram) -> None:
        self.diagram = diagram
        self.nodes = {node.id: node for node in diagram.frame.walk()}
        self.parents = {child.id: node.id for node in diagram.frame.walk() for child in node.nodes}
        self.right_ports = self._right_ports()
        self.loops: dict[str, list[int]] = defaultdict(list)
        self.routes: dict[int, Route] = {}
        self.inner: dict[str, list[tuple[int, int]]] = defaultdict(list)
        for number, edge in enumerate(diagram.edges):
            if edge.source == edge.target and edge.source_port is None:
                self.loops[edge.source].append(number)
                continue
            self.routes[number] = self._route(edge)
            for leg, (container, _, _) in enumerate(self.routes[number].legs):
                self.inner[container].append((number, leg))
        for node in diagram.frame.walk():
            self._flip(node)
        self.ends: dict[tuple[str, Side], list[tuple[int, bool]]] = defaultdict(list)
        self._collect_ends()
        self.reserved: dict[str, dict[int, Side]] = defaultdict(dict)
        self._reserve()

    def _right_ports(self) -> set[str]:
        """Output ports, by direction or, for `inout`, by use."""
        sources = {edge.source_port for edge in self.diagram.edges}
        targets = {edge.target_port for edge in self.diagram.edges}
        found = set()
        for node in self.nodes.values():
            # Outputs of the frame are on the right as well; inside it, they are targets.
            inner = (targets, sources) if node.kind == "frame" else (sources, targets)
            for port in node.ports:
                both = port.id in inner[0] and port.id not in inner[1]
                if port.direction == "out" or (port.direction == "inout" and both):
                    found.add(port.id)
        return found

    def _above(self, node: str) -> list[str]:
        """Return a node and its containers up to the frame."""
        found = [node]
        while found[-1] in self.parents:
            found.append(self.parents[found[-1]])
        return found

    def _route(self, edge: Edge) -> Route:
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
        # Between regions that fill their state is no room.
        labelled = next(
            at
            for at, (container, _, _) in enumerate(legs)
            if at == main or self.nodes[container].kind != "parallel"
        )
        return Route(edge, legs, main, labelled)

    def _flip(self, node: Node) -> None:
        """Choose the backward edges of a container."""
        index = {child.id: at for at, child in enumerate(node.nodes)}
        found = []
        for number, leg in self.inner[node.id]:
            route = self.routes[number]
            _, source, target = route.legs[leg]
            if leg == route.main and source is not None and target is not None:
                found.append((route, index[source], index[target]))
        edges = [(source, target) for _, source, target in found]
        for at in feedback_edges(len(index), edges, ()):
            found[at][0].flipped = True

    def _collect_ends(self) -> None:
        """List the edges on each side of each node, which determine its minimum width."""
        for number, route in self.routes.items():
            out: Side = "first" if route.flipped else "last"
            into: Side = "last" if route.flipped else "first"
            self.ends[route.edge.source, out].append((number, True))
            self.ends[route.edge.target, into].append((number, False))

    def _reserve(self) -> None:
        """Give edges that end at a container a place among those that cross the same side."""
        crossed: set[tuple[str, Side]] = set()
        for route in self.routes.values():
            for leg, (container, source, target) in enumerate(route.legs):
                if source is None and leg > 0:
                    crossed.add((container, route.entry(leg)))
                if target is None and leg < len(route.legs) - 1:
                    crossed.add((container, route.exit(leg)))
        for (node, side), ends in self.ends.items():
            if (node, side) in crossed and self.nodes[node].kind != "parallel":
                for number, _ in ends:
                    if all(container != node for container, _, _ in self.routes[number].legs):
                        self.reserved[node][number] = side

    def crosses(self, node: str, number: int, is_last: bool) -> bool:
        """Return True if the place of an edge on a node is determined inside of that."""
        return not is_last or number in self.reserved.get(node, ())
