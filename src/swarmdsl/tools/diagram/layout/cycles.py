"""Which edges point backwards, so that the others go one way."""

from __future__ import annotations

from collections.abc import Sequence


def backward(count: int, edges: Sequence[tuple[int, int]], roots: Sequence[int]) -> set[int]:
    """Numbers of edges without which a graph has no circles; only edges in circles are taken.

    Either those against the order of the nodes, which is that of the model, or those that
    lead back to where a walk from the roots came from, whichever are fewer.
    """
    part = _circles(count, edges)
    inside = [at for at, (tail, head) in enumerate(edges) if part[tail] == part[head]]
    written = {at for at in inside if edges[at][0] >= edges[at][1]}
    walked = _walked(count, edges, roots)
    return walked if len(walked) < len(written) else written


def _walked(count: int, edges: Sequence[tuple[int, int]], roots: Sequence[int]) -> set[int]:
    """Edges to a node that the walk has entered and not left."""
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


def _circles(count: int, edges: Sequence[tuple[int, int]]) -> list[int]:
    """The strongly connected component of each node (Tarjan 1972)."""
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
