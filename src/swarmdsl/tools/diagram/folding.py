"""A diagram in which the insides of some boxes are hidden."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from swarmdsl.base.records import replace
from swarmdsl.codegen.diagram.graph import Diagram, Edge, Node


def folded(diagram: Diagram, ids: Collection[str]) -> Diagram:
    """The diagram with the nodes of these ids folded; ids of others mean nothing.

    An edge from or to what is hidden is one of the folded node; one between two of what is
    hidden in the same node, or between that and the node, is hidden too. Of those that look the
    same then, one is shown.
    """
    shown = {
        hidden.id: node.id
        for node in _outermost(diagram.frame, ids)
        for child in node.nodes
        for hidden in child.walk()
    }
    return replace(
        diagram,
        frame=_folded(diagram.frame, ids),
        edges=tuple(_edges(diagram.edges, shown)),
    )


def _outermost(node: Node, ids: Collection[str]) -> Iterator[Node]:
    if _folds(node, ids):
        yield node
        return
    for child in node.nodes:
        yield from _outermost(child, ids)


def _folds(node: Node, ids: Collection[str]) -> bool:
    return node.id in ids and node.foldable


def _folded(node: Node, ids: Collection[str]) -> Node:
    if _folds(node, ids):
        return replace(node, nodes=(), compartments=(), internal=(), folded=True)
    return replace(node, nodes=tuple(_folded(child, ids) for child in node.nodes))


def _edges(edges: Collection[Edge], shown: dict[str, str]) -> Iterator[Edge]:
    found = set()
    for edge in edges:
        source, target = shown.get(edge.source, edge.source), shown.get(edge.target, edge.target)
        if (source, target) == (edge.source, edge.target):
            yield edge
            continue
        looks = (edge.kind, source, target, edge.label)
        if source != target and looks not in found:
            found.add(looks)
            yield replace(edge, source=source, target=target)
