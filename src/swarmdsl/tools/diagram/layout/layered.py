"""Layered layout of one container (Sugiyama, Tagawa, Toda 1981)."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.tools.diagram.layout.coordinates import assign_coordinates
from swarmdsl.tools.diagram.layout.layered_graph import Cell, Link, Placement
from swarmdsl.tools.diagram.layout.layering import make_layers
from swarmdsl.tools.diagram.layout.ordering import order
from swarmdsl.tools.diagram.layout.routing import route


def layered(
    cells: Sequence[Cell], links: Sequence[Link], pitch: int, before: bool, in_row: bool
) -> Placement:
    """Lay out cells and links; `pitch` is the distance of a label from its line.

    `before` selects the default side of labels. With `in_row`, the cells of a layer are aligned at
    their start.
    """
    layers = make_layers(cells, links, pitch)
    order(layers)
    assign_coordinates(layers, cells, links, pitch, before)
    return route(layers, cells, links, pitch, in_row)
