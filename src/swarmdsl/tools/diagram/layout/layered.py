"""Layered layout of one container (Sugiyama, Tagawa, Toda 1981)."""

from __future__ import annotations

from swarmdsl.tools.diagram.layout.coordinates import assign_coordinates
from swarmdsl.tools.diagram.layout.layered_graph import Placement
from swarmdsl.tools.diagram.layout.level import Level
from swarmdsl.tools.diagram.layout.routing import route
from swarmdsl.tools.diagram.layout.rows import wrap


def layered(level: Level, in_row: bool, rows: int) -> Placement:
    """Lay out the cells and links of a container whose cells have their order and sizes.

    With `in_row`, the cells of a layer are aligned at their start. There may be fewer `rows`.
    """
    if rows > 1:
        wrap(level.layers, rows)
    assign_coordinates(level.layers, level.cells, level.links, level.pitch, level.label_before)
    return route(level.layers, level.cells, level.links, level.pitch, in_row)
