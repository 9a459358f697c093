"""Network simplex: integers that minimize the weighted sum of differences.

Used for layers and for coordinates within layers. Gansner, Koutsofios, North, Vo: A Technique for
Drawing Directed Graphs, IEEE TSE 19 (1993), sections 2.3 and 4.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from heapq import heapify, heappop, heappush

Constraint = tuple[int, int, int, int]
"""(tail, head, length, weight): head >= tail + length; more costs weight per unit."""

_MAX_STEPS = 500_000
"""Approximate step limit; the result may then not be optimal."""
_MAX_CANDIDATES = 30


def minimize(count: int, constraints: Sequence[Constraint]) -> list[int]:
    """Find `count` numbers that satisfy the constraints at minimum cost.

    The smallest is 0. The constraints (tail, head, length, weight) have no cycles.
    """
    if count == 0:
        return []
    network = Network(count, constraints)
    network.solve()
    network.balance()
    return network.numbers()


class Network:
    """A feasible spanning tree of tight edges that is improved edge by edge.

    Constraints may have cycles if `start` has numbers that satisfy them. The first edges are the
    constraints; `solve` goes on from the numbers found after a change of a `weight`.
    """

    def __init__(
        self, count: int, constraints: Sequence[Constraint], start: Sequence[int] | None = None
    ) -> None:
        heads = {head for _, head, _, _ in constraints}
        # The root connects separate components at no cost.
        loose = [(count, node, 0, 0) for node in range(count) if node not in heads]
        self.count = count + 1
        edges = [*constraints, *loose]
        self.tail = [edge[0] for edge in edges]
        self.head = [edge[1] for edge in edges]
        self.length = [edge[2] for edge in edges]
        self.weight = [edge[3] for edge in edges]
        self.both = [tail + head for tail, head in zip(self.tail, self.head, strict=True)]
        self.incident: list[list[int]] = [[] for _ in range(self.count)]
        for edge, (tail, head) in enumerate(zip(self.tail, self.head, strict=True)):
            self.incident[tail].append(edge)
            self.incident[head].append(edge)
        self.rank = [0] * self.count
        self.in_tree = [False] * len(self.tail)
        self.tree: list[list[int]] = [[] for _ in range(self.count)]
        self.cut = [0] * len(self.tail)
        # For each node of the rooted tree: the edge to its parent, and its depth.
        self.parent = [-1] * self.count
        self.depth = [0] * self.count
        # The nodes below the edge that leaves the tree have the latest mark.
        self.mark = [0] * self.count
        self.marks = 0
        if start is None:
            self.longest_paths()
        else:
            self.rank = [*start, min(start)]
        self.span()

    def numbers(self) -> list[int]:
        """Return the numbers found; the smallest is 0."""
        least = min(self.rank[:-1])
        return [value - least for value in self.rank[:-1]]

    def solve(self) -> None:
        """Improve the numbers."""
        self.cut_values(self.root())
        members = self.members()
        work, at = _MAX_STEPS, 0
        while work > 0:
            leaving, at = self.leaving(members, at)
            if leaving is None:
                break
            moved = self.moved(members[leaving])
            entering = self.entering(members[leaving], moved)
            if entering is None:
                break
            self.exchange(members[leaving], entering, moved)
            work -= 2 * len(moved) + len(members) // 4
            members[leaving] = entering

    def members(self) -> list[int]:
        """Return the edges of the tree."""
        return [edge for edge, inside in enumerate(self.in_tree) if inside]

    def slack(self, edge: int) -> int:
        """Return the amount by which an edge is longer than it must be."""
        return self.rank[self.head[edge]] - self.rank[self.tail[edge]] - self.length[edge]

    def longest_paths(self) -> None:
        """Compute the smallest numbers that satisfy all constraints."""
        waits = [0] * self.count
        for head in self.head:
            waits[head] += 1
        ready = [node for node in range(self.count) if not waits[node]]
        for node in ready:
            for edge in self.incident[node]:
                if self.tail[edge] != node:
                    continue
                head = self.head[edge]
                self.rank[head] = max(self.rank[head], self.rank[node] + self.length[edge])
                waits[head] -= 1
                if not waits[head]:
                    ready.append(head)
        assert len(ready) == self.count, "constraints have a cycle"

    def span(self) -> None:
        """Build a tree of tight edges, joining the smallest part to the nearest other."""
        part = list(range(self.count))
        members: list[list[int]] = [[node] for node in range(self.count)]

        def join(edge: int) -> int:
            one, other = part[self.tail[edge]], part[self.head[edge]]
            if len(members[one]) < len(members[other]):
                one, other = other, one
            for node in members[other]:
                part[node] = one
            members[one] += members[other]
            members[other] = []
            self.in_tree[edge] = True
            self.tree[self.tail[edge]].append(edge)
            self.tree[self.head[edge]].append(edge)
            return one

        for edge in range(len(self.tail)):
            if part[self.tail[edge]] != part[self.head[edge]] and not self.slack(edge):
                join(edge)
        heap = [(len(nodes), number) for number, nodes in enumerate(members) if nodes]
        heapify(heap)
        while len(heap) > 1:
            size, number = heappop(heap)
            if len(members[number]) != size:
                continue
            best, least = -1, 0
            for node in members[number]:
                for edge in self.incident[node]:
                    if part[self.tail[edge]] != part[self.head[edge]]:
                        slack = self.slack(edge)
                        if best < 0 or slack < least:
                            best, least = edge, slack
            if best < 0:
                break  # nothing left to join
            delta = least if part[self.tail[best]] == number else -least
            for node in members[number]:
                self.rank[node] += delta
            joined = join(best)
            heappush(heap, (len(members[joined]), joined))

    def root(self) -> list[int]:
        """Direct the tree away from the last node; return its nodes, each after its parent."""
        order = [self.count - 1]
        for node in order:
            up = self.parent[node]
            for edge in self.tree[node]:
                if edge != up:
                    child = self.both[edge] - node
                    self.parent[child] = edge
                    self.depth[child] = self.depth[node] + 1
                    order.append(child)
        return order

    def cut_values(self, order: Sequence[int]) -> None:
        """Compute the cut values of all tree edges from the leaves to the root."""
        for node in reversed(order):
            if self.parent[node] >= 0:
                self.cut[self.parent[node]] = self.cut_value(node)

    def cut_value(self, node: int) -> int:
        """Cut value of the edge above a node, from those of the edges below."""
        above = self.parent[node]
        # The sign depends on whether the edge points to the node.
        inward = self.head[above] == node
        total = 0
        for edge in self.incident[node]:
            same = (self.head[edge] == node) == inward
            value = self.weight[edge] if same else -self.weight[edge]
            if edge != above and self.in_tree[edge]:
                value += -self.cut[edge] if same else self.cut[edge]
            total += value
        return total

    def leaving(self, members: list[int], start: int) -> tuple[int | None, int]:
        """Index of a tree edge with a negative cut value, and where to continue searching.

        Of several candidates, the one with the lowest value.
        """
        best, found, size = None, 0, len(members)
        for step in range(size):
            at = start + step
            at -= size if at >= size else 0
            if self.cut[members[at]] < 0:
                if best is None or self.cut[members[at]] < self.cut[members[best]]:
                    best = at
                found += 1
                if found == _MAX_CANDIDATES:
                    return best, at
        return best, start

    def below(self, edge: int) -> int:
        """End of a tree edge that is farther from the root."""
        tail, head = self.tail[edge], self.head[edge]
        return tail if self.parent[tail] == edge else head

    def moved(self, leaving: int) -> list[int]:
        """Mark and return the nodes below a tree edge."""
        self.marks += 1
        mark, marks, parent, both = self.mark, self.marks, self.parent, self.both
        found = [self.below(leaving)]
        mark[found[0]] = marks
        for node in found:
            up = parent[node]
            for edge in self.tree[node]:
                if edge != up:
                    child = both[edge] - node
                    mark[child] = marks
                    found.append(child)
        return found

    def entering(self, leaving: int, moved: Sequence[int]) -> int | None:
        """Non-tree edge with minimum slack that reconnects the tree the other way round."""
        # `leaving` may become longer until an edge in the other direction is tight.
        outward = self.head[leaving] == moved[0]
        ends = self.tail if outward else self.head
        best, least = None, 0
        mark, marks, both = self.mark, self.marks, self.both
        for node in moved:
            for edge in self.incident[node]:
                if ends[edge] == node and mark[both[edge] - node] != marks:
                    if self.in_tree[edge]:
                        continue
                    slack = self.slack(edge)
                    if best is None or slack < least:
                        best, least = edge, slack
                        if not slack:
                            return best
        return best

    def exchange(self, leaving: int, entering: int, moved: Sequence[int]) -> None:
        """Replace a tree edge, below which nodes have moved."""
        slack = self.slack(entering)
        inside = self.mark[self.head[entering]] == self.marks
        if slack:
            self.shift(moved, -slack if inside else slack)
        cut = self.cut[leaving]
        self.update(self.tail[entering], self.head[entering], cut)
        self.cut[entering], self.cut[leaving] = -cut, 0
        self.in_tree[leaving], self.in_tree[entering] = False, True
        for edge, change in ((leaving, list.remove), (entering, list.append)):
            change(self.tree[self.tail[edge]], edge)
            change(self.tree[self.head[edge]], edge)
        self.hang(self.head[entering] if inside else self.tail[entering], entering)

    def hang(self, top: int, edge: int) -> None:
        """Direct a part of the tree away from its new top, below an edge."""
        parent, depth, both = self.parent, self.depth, self.both
        parent[top] = edge
        depth[top] = depth[both[edge] - top] + 1
        part = [top]
        for node in part:
            up, level = parent[node], depth[node] + 1
            for each in self.tree[node]:
                if each != up:
                    child = both[each] - node
                    parent[child] = each
                    depth[child] = level
                    part.append(child)

    def shift(self, nodes: Sequence[int], delta: int) -> None:
        """Move nodes."""
        for node in nodes:
            self.rank[node] += delta

    def update(self, one: int, other: int, cut: int) -> None:
        """Correct cut values on the path between the ends of a new edge, up to where they meet."""
        parent, depth = self.parent, self.depth
        while one != other:
            if depth[one] >= depth[other]:
                edge = parent[one]
                self.cut[edge] += cut if self.tail[edge] == one else -cut
                one = self.both[edge] - one
            else:
                edge = parent[other]
                self.cut[edge] += -cut if self.tail[edge] == other else cut
                other = self.both[edge] - other

    def balance(self) -> None:
        """Center nodes that can move at no cost, at last: the tree is not tight any more."""
        work = _MAX_STEPS // 4
        for edge in self.members():
            if work <= 0:
                return
            if self.cut[edge] == 0 and self.weight[edge] + self.length[edge]:
                moved = self.moved(edge)
                entering = self.entering(edge, moved)
                if entering is None or (slack := self.slack(entering)) < 2:
                    continue
                inside = self.mark[self.head[entering]] == self.marks
                self.shift(moved, -(slack // 2) if inside else slack // 2)
                # The tree is no longer tight there, so this edge must not be used again.
                self.cut[edge] = 1
                work -= len(moved)
