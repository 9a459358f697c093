"""Cycles and topological order of graphs, without recursion."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator
from typing import TypeVar

N = TypeVar("N", bound=Hashable)
E = TypeVar("E")


def cycles(
    nodes: Iterable[N], edges: Callable[[N], Iterable[tuple[E, N]]]
) -> Iterator[tuple[N, list[E]]]:
    """Yield a node and the edges that lead from it back to it, once for each back edge.

    `edges` gives the outgoing edges of a node, each with the node it leads to.
    """
    done: set[N] = set()
    for root in nodes:
        if root in done:
            continue
        chain: dict[N, Iterator[tuple[E, N]]] = {root: iter(edges(root))}
        way: list[E] = []
        while chain:
            node = next(reversed(chain))
            step = next(chain[node], None)
            if step is None:
                done.add(node)
                del chain[node]
                if way:
                    way.pop()
                continue
            edge, target = step
            if target in chain:
                yield target, [*way[list(chain).index(target) :], edge]
            elif target not in done:
                way.append(edge)
                chain[target] = iter(edges(target))


def leaves_first(nodes: Iterable[N], edges: Callable[[N], Iterable[N]]) -> list[N]:
    """Order the nodes of a graph without cycles so that each comes after those it leads to."""
    done: dict[N, None] = {}
    for root in nodes:
        chain = [(root, iter(edges(root)))] if root not in done else []
        while chain:
            node, targets = chain[-1]
            target = next((target for target in targets if target not in done), None)
            if target is None:
                done[node] = None
                chain.pop()
            else:
                chain.append((target, iter(edges(target))))
    return list(done)
