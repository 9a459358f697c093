"""The layered layout of one container (Sugiyama, Tagawa, Toda 1981), a line a phase."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.tools.diagram.layout.layering import make_layers
from swarmdsl.tools.diagram.layout.level import Cell, Link, Placement
from swarmdsl.tools.diagram.layout.ordering import order
from swarmdsl.tools.diagram.layout.placing import place
from swarmdsl.tools.diagram.layout.routing import route


def layered(
    cells: Sequence[Cell], links: Sequence[Link], pitch: int, before: bool, in_row: bool
) -> Placement:
    """Lay out cells and links; `pitch` is between a line and its label.

    `before` says on which side of its line a label is if there is no reason for the other,
    `in_row` that the cells of a layer begin in a row.
    """
    layers = make_layers(cells, links, pitch)
    order(layers)
    place(layers, cells, links, pitch, before)
    return route(layers, cells, links, pitch, in_row)
