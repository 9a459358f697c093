"""Undo the lowering of the portable profile.

A result is stored by the transitions for the outcome of its activity, or by one before them. An
internal transition of a parallel state is in the region that contains its target; a transition
without effects remains at its original place. See `codegen.exchange.scxml.portable` and
`codegen.shared.parallel_transitions`.
"""

from __future__ import annotations

from typing import Any

from lark import Token, Tree

from swarmdsl.base.records import replace
from swarmdsl.execution.scxml.document import Node
from swarmdsl.execution.scxml.grammar import Unreadable, parse
from swarmdsl.importing.partial_states import Edge, PartialState
from swarmdsl.ir import StateKind


def undo_lowering(top: PartialState) -> None:
    """Restore the transitions of a document of the portable profile."""
    for draft in top.walk():
        activity = draft.payload_node("activity")
        if activity is not None:
            results = sum(node.name == "mapping" for node in activity.walk())
            _fold_results(draft, results)
        if draft.kind is StateKind.PARALLEL:
            _fold_inward(draft)


def _fold_results(draft: PartialState, results: int) -> None:
    end, stored = f"do.{draft.id}.succeeded", f"gives.{draft.id}.succeeded"
    left = [edge for edge in draft.edges if not (edge.event == end and _raises(edge, stored))]
    if len(left) == len(draft.edges):
        left = [
            replace(edge, content=_rest(edge.node, results)) if edge.event == end else edge
            for edge in left
        ]
    draft.edges = left


def _raises(edge: Edge, event: str) -> bool:
    return any(node.name == "raise" and node.get("event") == event for node in edge.actions[:1])


def _rest(node: Node, first: int) -> Node:
    """Copy of an element without its first children."""
    rest = Node(
        f"{node.namespace}}}{node.name}", node.attributes, node.parent, node.start, node.line
    )
    rest.children = node.children[first:]
    return rest


def _fold_inward(draft: PartialState) -> None:
    for index, edge in enumerate(draft.edges):
        if edge.target is not None or edge.node.children:
            continue
        condition = _guard(draft.edges[:index], edge)
        inner = next(
            (
                each
                for region in draft.children
                for each in region.edges
                if each.event == edge.event and _condition(each.node) == condition
            ),
            None,
        )
        if inner is not None:
            for region in draft.children:
                region.edges = [each for each in region.edges if each is not inner]
            draft.edges[index] = replace(edge, target=inner.target, content=inner.node)


def _guard(before: list[Edge], edge: Edge) -> Any:
    """Condition of an inner transition: its own, and none of those before it."""
    guards = [
        Tree("sign", [Token("NOT", "!"), _condition(each.node) or parse("true")])
        for each in before
        if each.event == edge.event and each.node is not edge.node
    ]
    own = _condition(edge.node)
    guards += [own] if own is not None else []
    made = None
    for guard in guards:
        made = guard if made is None else Tree("both", [made, guard])
    return made


def _condition(node: Node) -> Any:
    """Tree of a condition; None if there is none."""
    text = node.get("cond")
    try:
        return parse(text) if text else None
    except Unreadable:
        return None
