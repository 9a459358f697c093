"""Place regions side by side so that they fill their parallel state."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from swarmdsl.tools.diagram.layout.container_layout import ContainerLayout
from swarmdsl.tools.diagram.layout.edge_routes import EdgeRoutes
from swarmdsl.tools.diagram.layout.layered_graph import Cell, Link, Placement, Point


def place_regions(cells: Sequence[Cell], links: Sequence[Link]) -> Placement:
    """Place regions side by side, and border crossings on the border of the state."""
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


def stretch_regions(
    state: ContainerLayout,
    regions: Mapping[str, ContainerLayout],
    length: int,
    passages: EdgeRoutes,
) -> None:
    """Stretch the regions of a state to its full size; `length` is their size along."""
    axis = 1 if state.direction == "down" else 0
    for id_, region in regions.items():
        ended = region.height if axis else region.width
        if axis:
            region.height = length
        else:
            region.width = length
        for number, points in region.segments_of.items():
            _, source, target = next(
                each for each in passages.routes[number].legs if each[0] == id_
            )
            for at, end in ((0, source), (-1, target)):
                # An edge to the region itself may end at a side, in the direction of its inside.
                if end is None and points[at][axis] == ended:
                    x, y = points[at]
                    points[at] = (x, length) if axis else (length, y)
    last_id = list(regions)[-1]
    last = regions[last_id]
    if axis:
        last.width = state.width - state.children[last_id][0]
    else:
        last.height = state.height - state.children[last_id][1]
