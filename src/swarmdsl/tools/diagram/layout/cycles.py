"""Choose the edges to reverse so that a graph has no cycles."""

from __future__ import annotations

from collections.abc import Sequence


def feedback_edges(count: int, edges: Sequence[tuple[int, int]], roots: Sequence[int]) -> set[int]:
    """Return the indices of edges that break all cycles when reversed.

    The smaller of two sets: edges against the order of nodes in the model, or back edges of a
    depth-first search from the roots. Both contain only edges in cycles.
    """
    component = _components(count, edges)
    cyclic = [at for at, (tail, head) in enumerate(edges) if component[tail] == component[head]]
    against_order = {at for at in cyclic if edges[at][0] >= edges[at][1]}
    back_edges = _back_edges(count, edges, roots)
    return back_edges if len(back_edges) < len(against_order) else against_order


def _back_edges(count: int, edges: Sequence[tuple[int, int]], roots: Sequence[int]) -> set[int]:
    """Back edges of a depth-first search."""
    leaving: list[list[int]] = [[] for _ in range(count)]
    for at, (tail, _) in enumerate(edges):
        leaving[tail].append(at)
    fresh, open_, done = range(3)
    state = [fresh] * count
    found: set[int] = set()
    for root in (*roots, *range(count)):
        if state[root] != fresh:
            continue
        state[root] = open_
        stack = [(root, iter(leaving[root]))]
        while stack:
            node, rest = stack[-1]
            for at in rest:
                head = edges[at][1]
                if state[head] == open_:
                    found.add(at)
                elif state[head] == fresh:
                    state[head] = open_
                    stack.append((head, iter(leaving[head])))
                    break
            else:
                state[node] = done
                stack.pop()
    return found


def _components(count: int, edges: Sequence[tuple[int, int]]) -> list[int]:
    """Strongly connected component of each node (Tarjan 1972)."""
    heads: list[list[int]] = [[] for _ in range(count)]
    for tail, head in edges:
        heads[tail].append(head)
    number = [-1] * count
    low = [0] * count
    part = [-1] * count
    trail: list[int] = []
    counter = 0
    for root in range(count):
        if number[root] >= 0:
            continue
        stack = [(root, 0)]
        while stack:
            node, at = stack.pop()
            if at == 0:
                number[node] = low[node] = counter
                counter += 1
                trail.append(node)
            elif part[heads[node][at - 1]] < 0:
                low[node] = min(low[node], low[heads[node][at - 1]])
            if at < len(heads[node]):
                stack.append((node, at + 1))
                head = heads[node][at]
                if number[head] < 0:
                    stack.append((head, 0))
                elif part[head] < 0:
                    low[node] = min(low[node], number[head])
                continue
            if low[node] == number[node]:
                while True:
                    other = trail.pop()
                    part[other] = node
                    if other == node:
                        break
    return part
