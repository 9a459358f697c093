"""Choose the direction of the layout of each level.

The size of a container in either direction is estimated from its layers, before anything is laid
out. From a start with one direction everywhere, directions are turned as long as the diagram then
fits its page better: a local search for the orientations of Stockmeyer: Optimal Orientations of
Cells in Slicing Floorplan Designs (1983), which also asks for the shape of the whole.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
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
_MAX_SEARCHED = 60
"""Maximum number of containers for which single ones are turned, not only whole levels."""
_ROUNDS = 4
_OTHER: dict[Direction, Direction] = {"down": "right", "right": "down"}

Directions = dict[str, Direction]


def uniform(diagram: Diagram, direction: Direction) -> Directions:
    """Return the same direction for all nodes."""
    return {node.id: direction for node in diagram.frame.walk()}


def fitted_size(wide: int, high: int) -> float:
    """Size of a picture when it is fitted on a page; of two such, that with the page's shape."""
    return max(wide / ASPECT, high) + 0.2 * abs(log(wide / high / ASPECT))


def choose_directions(diagram: Diagram, routes: EdgeRoutes, texts: Texts) -> Iterator[Directions]:
    """Yield the best directions with the whole downwards, and with it to the right.

    They are yielded best first, by the estimate.
    """
    sizes = Sizes(routes, texts)
    containers = [node for node in diagram.frame.walk() if node.nodes]
    found: list[tuple[float, int, Directions]] = []
    for start in _OTHER:
        directions = uniform(diagram, start)
        least = _search(diagram, routes, sizes, directions, _moves(diagram, containers))
        found.append((least, len(found), directions))
    yield from (directions for _, _, directions in sorted(found, key=lambda each: each[:2]))


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


def _search(
    diagram: Diagram,
    routes: EdgeRoutes,
    sizes: Sizes,
    directions: Directions,
    moves: Sequence[Sequence[str]],
) -> float:
    """Turn what makes the diagram smaller on its page; return its size then."""

    def size(chosen: Mapping[str, Direction]) -> float:
        return fitted_size(*sizes.of(diagram.frame, chosen))

    aligned = list(_aligned(diagram.frame, routes))

    least = size(directions)
    for _ in range(_ROUNDS):
        before = least
        for move in moves:
            turned = directions | {each: _OTHER[directions[each]] for each in move}
            for state, container in aligned:
                turned[state] = turned[container]
            if (found := size(turned)) < least * (1 - _LEAST_GAIN):
                least = found
                directions.update(turned)
        if least == before:
            return least
    return least


def _aligned(node: Node, routes: EdgeRoutes) -> Iterator[tuple[str, str]]:
    """Yield states with the container whose direction they have, from the outside in.

    States with regions that edges enter or leave: regions fill their state, so that there is no
    room in which such an edge could turn.
    """
    for child in node.nodes:
        if child.kind == "parallel" and routes.inner[child.id]:
            yield child.id, node.id
        yield from _aligned(child, routes)
