"""Edges at the border of a container: where they cross it, and how they get there.

A layout has its border crossings before its first layer and after its last one. If the layout
around runs in the other direction, an edge turns once on its way there, on a track beside the
layers. The tracks are in an order in which these edges do not cross.
"""

from __future__ import annotations

from swarmdsl.tools.diagram.layout.edge_routes import EdgeRoutes
from swarmdsl.tools.diagram.layout.layered_graph import Placement, Point, Side

TRACK = 12
"""Distance between tracks: that of lines in a layer, so that edges stay straight."""
_MARGIN = 4
"""Distance of the tracks from the layers, beside the padding."""


class Border:
    """Border crossings of a container, with their `cells` by edge number and side.

    Coordinates are those of the container's layout, along and across.
    """

    def __init__(
        self, node: str, routes: EdgeRoutes, cells: dict[tuple[int, Side], int], turns: bool
    ) -> None:
        self.node = node
        self.routes = routes
        self.cells = cells
        self.turns = turns
        self._across: dict[int, int] = {}
        self._tracks: dict[int, int] = {}
        self._sides: dict[int, Side] = dict(cells.keys())
        self._count: dict[Side, int] = {"first": 0, "last": 0}
        self._start = 0

    def passes_header(self) -> bool:
        """Return True if an edge goes straight through the first border."""
        return any(
            side == "first" and not (self.turns and self._goes_on(number))
            for number, side in self.cells
        )

    def _goes_on(self, number: int) -> bool:
        """Return True if an edge does not end at this border from inside."""
        if number in self.routes.reserved.get(self.node, ()):
            return True
        legs = self.routes.routes[number].legs
        at = next(at for at, leg in enumerate(legs) if leg[0] == self.node)
        _, source, target = legs[at]
        return (source is None and at > 0) or (target is None and at < len(legs) - 1)

    def place(self, placement: Placement, before_along: int, before_across: int) -> None:
        """Take the places of the crossings, and give tracks to the edges that turn."""
        self._start = before_along
        self._length = placement.length
        for (number, _), cell in self.cells.items():
            self._across[number] = placement.cells[cell][1] + before_across
        if not self.turns:
            return
        # Farther across means farther out before the layers, and farther in after them.
        for number in sorted(self._across, key=lambda each: -self._across[each]):
            if self._goes_on(number):
                side = self._sides[number]
                self._tracks[number] = self._count[side]
                self._count[side] += 1

    def room(self, side: Side) -> int:
        """Space along for the tracks on a side."""
        return self._count[side] * TRACK + _MARGIN if self._count[side] else 0

    def _track(self, number: int) -> int:
        track = self._tracks[number] * TRACK
        if self._sides[number] == "first":
            return self._start + track
        return self._start + self.room("first") + self._length + _MARGIN + track

    def extend(self, number: int, points: list[Point], length: int, breadth: int) -> None:
        """Extend a route to the border, through header and padding."""
        side = self._sides.get(number)
        if side is None:
            return
        across = self._across[number]
        if number in self._tracks:
            track = self._track(number)
            way = [(track, across), (track, 0 if side == "first" else breadth)]
        else:
            way = [(0 if side == "first" else length, across)]
        legs = self.routes.routes[number].legs
        _, source, _ = next(leg for leg in legs if leg[0] == self.node)
        if source is None:
            points[:0] = reversed(way)
        else:
            points += way

    def crossings(self, length: int) -> dict[int, int]:
        """Return the positions on the sides that face the layers around."""
        return {
            number: self._track(number) if number in self._tracks else across
            for number, across in self._across.items()
        }

    def arrows(self) -> list[tuple[int, Side]]:
        """Return the positions of arrow heads that meet the border from inside, with their side."""
        return [
            (self._across[number], side)
            for number, side in self.cells
            if self.routes.routes[number].edge.target == self.node and not self._goes_on(number)
        ]
