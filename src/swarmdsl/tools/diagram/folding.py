"""Hide the content of selected nodes in a diagram."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from swarmdsl.base.records import replace
from swarmdsl.codegen.diagram.graph import Diagram, Edge, Node


def fold(diagram: Diagram, ids: Collection[str]) -> Diagram:
    """Fold the nodes with the given ids; unknown ids are ignored.

    Edges of hidden nodes move to the folded node, and edges inside it are hidden. Of edges that
    then look the same, one is kept.
    """
    shown = {
        hidden.id: node.id
        for node in _outermost(diagram.frame, ids)
        for child in node.nodes
        for hidden in child.walk()
    }
    return replace(
        diagram,
        frame=_fold(diagram.frame, ids),
        edges=tuple(_visible_edges(diagram.edges, shown)),
    )


def _outermost(node: Node, ids: Collection[str]) -> Iterator[Node]:
    if _is_folded(node, ids):
        yield node
        return
    for child in node.nodes:
        yield from _outermost(child, ids)


def _is_folded(node: Node, ids: Collection[str]) -> bool:
    return node.id in ids and node.foldable


def _fold(node: Node, ids: Collection[str]) -> Node:
    if _is_folded(node, ids):
        return replace(node, nodes=(), compartments=(), internal=(), folded=True)
    return replace(node, nodes=tuple(_fold(child, ids) for child in node.nodes))


def _visible_edges(edges: Collection[Edge], shown: dict[str, str]) -> Iterator[Edge]:
    found = set()
    for edge in edges:
        source, target = shown.get(edge.source, edge.source), shown.get(edge.target, edge.target)
        if (source, target) == (edge.source, edge.target):
            yield edge
            continue
        appearance = (edge.kind, source, target, edge.label)
        if source != target and appearance not in found:
            found.add(appearance)
            yield replace(edge, source=source, target=target)
