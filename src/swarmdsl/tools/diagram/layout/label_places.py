"""Place labels beside the lines of their edges, near the sources."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.tools.diagram.layout.layered_graph import (
    Cell,
    End,
    LayerPositions,
    Layers,
    Link,
    Point,
    Vertex,
)

LABEL_MARGIN = 8
"""Space before and after a label along its line."""
_FREE = 4
"""Space between a label and what else is in the layer of its source."""


def place_labels(
    layers: Layers,
    cells: Sequence[Cell],
    links: Sequence[Link],
    placed: LayerPositions,
    pitch: int,
) -> list[Point | None]:
    """Return the position of the label of each link.

    A label is at the end of its layer that its line enters, or beside its source if that leaves
    room in its own layer: a state beside a long composite one.
    """
    labels: list[Point | None] = [None] * len(links)
    ends: dict[int, list[End]] = {}
    for segment in layers.segments:
        for end in (segment.start, segment.end):
            if end.vertex.cell is not None:
                ends.setdefault(id(end.vertex), []).append(end)
    for segment in layers.segments:
        label, source = segment.end.vertex, segment.start
        if not label.is_label:
            continue
        along = placed.starts[label.layer]
        if segment.end.side == "last":
            along += placed.lengths[label.layer] - label.length
        if source.vertex.cell is not None and source.across == segment.end.across:
            beside = _beside(label, source, cells, placed)
            if beside is not None and _is_free(label, source, layers, ends[id(source.vertex)]):
                along = beside
        labels[segment.link] = along, label.across + (0 if label.line else pitch)
    return labels


def _beside(
    label: Vertex, source: End, cells: Sequence[Cell], placed: LayerPositions
) -> int | None:
    """Position along of a label beside its source, if there is room in the layer."""
    layer = source.vertex.layer
    at = placed.cell(cells[source.vertex.cell or 0], layer, source.vertex.length)
    before = at - placed.starts[layer]
    after = placed.lengths[layer] - before - source.vertex.length
    if (before if source.side == "first" else after) < label.length + LABEL_MARGIN:
        return None
    if source.side == "first":
        return at - LABEL_MARGIN - label.length
    return at + source.vertex.length + LABEL_MARGIN


def _is_free(label: Vertex, source: End, layers: Layers, ends: Sequence[End]) -> bool:
    """Return True if nothing else is beside a source, in the range of its label across."""
    low, high = label.across - _FREE, label.across + label.breadth + _FREE
    return not any(
        low < end.across < high for end in ends if end is not source and end.side == source.side
    ) and not any(
        vertex.across < high and vertex.across + vertex.breadth > low
        for vertex in layers.layers[source.vertex.layer]
        if vertex is not source.vertex
    )
