"""Regions of a parallel state, which fill it, beside each other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from swarmdsl.tools.diagram.layout.inside import Inside
from swarmdsl.tools.diagram.layout.level import Cell, Link, Placement, Point
from swarmdsl.tools.diagram.layout.passages import Passages


def put_beside(cells: Sequence[Cell], links: Sequence[Link]) -> Placement:
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


def stretch(state: Inside, regions: Mapping[str, Inside], length: int, passages: Passages) -> None:
    """Make the regions of a state, by their ids, fill it: they are `length` long along it."""
    for id_, region in regions.items():
        region.length = length
        for number, points in region.pieces.items():
            _, source, target = next(
                each for each in passages.routes[number].legs if each[0] == id_
            )
            if source is None and points[0][0] > 0:
                points[0] = (length, points[0][1])
            if target is None and points[-1][0] > 0:
                points[-1] = (length, points[-1][1])
    last_id = list(regions)[-1]
    regions[last_id].breadth = state.breadth - state.children[last_id][1]
