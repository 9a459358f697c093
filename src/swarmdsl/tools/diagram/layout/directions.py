"""Choose the direction of the layout of each level, and its number of rows.

The size of a container in either direction is estimated from its layers, before anything is laid
out. From a start with one direction everywhere, directions are turned as long as the diagram then
fits its page better: a local search for the orientations of Stockmeyer: Optimal Orientations of
Cells in Slicing Floorplan Designs (1983), which also asks for the shape of the whole. If the
diagram is large then, long levels are wrapped into rows where that makes it much smaller.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import log

from swarmdsl.codegen.diagram.graph import Diagram, Node
from swarmdsl.tools.diagram.layout.edge_routes import EdgeRoutes
from swarmdsl.tools.diagram.layout.size_estimate import Sizes
from swarmdsl.tools.diagram.layout.texts import Texts
from swarmdsl.tools.diagram.shapes import Direction

ASPECT = 1.6
"""Preferred ratio of width to height."""
_LEAST_GAIN = 0.03
"""Share of its size that a diagram must lose for a turn: small edits then rarely turn something."""
_PAGE = 2_400
"""Size of a diagram from which on the layers of a container are wrapped into rows."""
_LEAST_GAIN_OF_ROWS = 0.25
"""Share of its size that a diagram must lose for that."""
_MAX_ROWS = 32
_MAX_SEARCHED = 60
"""Maximum number of containers for which single ones are turned, not only whole levels."""
_ROUNDS = 4
_OTHER: dict[Direction, Direction] = {"down": "right", "right": "down"}

Directions = dict[str, Direction]
Rows = dict[str, int]
"""Number of rows by the id of a container, for those with more than one."""


def uniform(diagram: Diagram, direction: Direction) -> Directions:
    """Return the same direction for all nodes."""
    return {node.id: direction for node in diagram.frame.walk()}


def fitted_size(wide: int, high: int) -> float:
    """Size of a picture when it is fitted on a page; of two such, that with the page's shape."""
    return max(wide / ASPECT, high) + 0.2 * abs(log(wide / high / ASPECT))


def choose_directions(
    diagram: Diagram, routes: EdgeRoutes, texts: Texts
) -> Iterator[tuple[Directions, Rows]]:
    """Yield the best directions with the whole downwards, and with it to the right.

    They are yielded best first, by the estimate, with the number of rows of containers.
    """
    sizes = Sizes(routes, texts)
    containers = [node for node in diagram.frame.walk() if node.nodes]
    moves = _moves(diagram, containers)
    found: list[tuple[float, int, Directions, Rows]] = []
    for start in _OTHER:
        search = _Search(diagram, routes, sizes, uniform(diagram, start))
        search.turn(moves)
        if search.least > _PAGE:
            search.wrap([[diagram.frame.id], *moves])
        found.append((search.least, len(found), search.directions, search.rows))
    yield from (choice[2:] for choice in sorted(found, key=lambda each: each[:2]))


def _moves(diagram: Diagram, containers: Sequence[Node]) -> list[list[str]]:
    """Return sets to turn together: a level, the children of one container, and each by itself."""
    levels: list[list[str]] = []

    def walk(node: Node, depth: int) -> None:
        for child in node.nodes:
            if child.nodes:
                if depth == len(levels):
                    levels.append([])
                levels[depth].append(child.id)
                walk(child, depth + 1)

    walk(diagram.frame, 0)
    moves = levels
    if len(containers) <= _MAX_SEARCHED:
        moves += ([node.id] for node in containers[1:])
        moves += ([each.id for each in node.nodes if each.nodes] for node in containers[1:])
    # From the level at which a turn changes most to single containers.
    return [move for at, move in enumerate(moves) if move and move not in moves[:at]]


class _Search:
    """Directions and rows of containers, while they are improved; `least` is their size."""

    def __init__(
        self, diagram: Diagram, routes: EdgeRoutes, sizes: Sizes, directions: Directions
    ) -> None:
        self.diagram = diagram
        self.sizes = sizes
        self.directions = directions
        self.rows: Rows = {}
        self.aligned = list(_aligned(diagram.frame, routes))
        self.least = self.size(directions, {})

    def size(self, directions: Directions, rows: Rows) -> float:
        return fitted_size(*self.sizes.of(self.diagram.frame, directions, rows))

    def turn(self, moves: Sequence[Sequence[str]]) -> None:
        """Turn what makes the diagram smaller on its page."""
        for _ in range(_ROUNDS):
            before = self.least
            for move in moves:
                turned = self.directions | {each: _OTHER[self.directions[each]] for each in move}
                for state, container in self.aligned:
                    turned[state] = turned[container]
                if (found := self.size(turned, self.rows)) < self.least * (1 - _LEAST_GAIN):
                    self.least = found
                    self.directions = turned
            if self.least == before:
                return

    def wrap(self, moves: Sequence[Sequence[str]]) -> None:
        """Wrap what makes the diagram much smaller on its page, and turn levels again."""
        nodes = {node.id: node for node in self.diagram.frame.walk() if node.nodes}
        layers = {id_: self.sizes.layer_count(node) for id_, node in nodes.items()}
        for move in moves:
            wrapped = self.rows
            least = self.least * (1 - _LEAST_GAIN_OF_ROWS)
            for count in range(2, _MAX_ROWS + 1):
                rows = {each: count for each in move if layers[each] >= 2 * count}
                if rows and (found := self.size(self.directions, self.rows | rows)) < least:
                    least, wrapped = found, self.rows | rows
            if wrapped is not self.rows:
                self.least, self.rows = least, wrapped
                self.turn(moves)


def _aligned(node: Node, routes: EdgeRoutes) -> Iterator[tuple[str, str]]:
    """Yield states with the container whose direction they have, from the outside in.

    States with regions that edges enter or leave: regions fill their state, so that there is no
    room in which such an edge could turn.
    """
    for child in node.nodes:
        if child.kind == "parallel" and routes.inner[child.id]:
            yield child.id, node.id
        yield from _aligned(child, routes)
