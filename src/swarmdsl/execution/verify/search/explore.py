"""Breadth-first search of the states of a swarm, within limits."""

from __future__ import annotations

from array import array

from swarmdsl.execution.verify.automata.limits import Budget
from swarmdsl.execution.verify.properties.observer import Observer
from swarmdsl.execution.verify.swarm.network import Network

_OFTEN = 1024
"""Number of states and steps between two looks at the limits, of one group of robots."""


def often(network: Network) -> int:
    """Return the number of states and steps between two looks at the limits."""
    return max(_OFTEN // len(network.groups), 1)


class Graph:
    """States that a search has found, in the order of their distance from the start.

    `parents` has the number of the state from which each was found first. `first` has the number
    of the first state with a robot at a place, `stuck` those in which nothing can happen. The
    search is `complete` if there are no more states.
    """

    def __init__(self, network: Network) -> None:
        self.network = network
        self.seen: dict[int, None] = {}
        self.parents = array("I")
        self.first: dict[int, int] = {}
        self.stuck: list[int] = []
        self.bad: int | None = None
        self.transitions = 0
        self.complete = False

    def way(self, number: int) -> list[int]:
        """Return the states on a shortest way to one, from the start on."""
        numbers = [number]
        while numbers[-1]:
            numbers.append(self.parents[numbers[-1]])
        wanted = set(numbers)
        found = {n: state for n, state in enumerate(self.seen) if n in wanted}
        return [found[each] for each in reversed(numbers)]


def explore(network: Network, budget: Budget) -> Graph:
    """Find all states of a swarm."""
    graph = Graph(network)
    start = network.start()
    seen, parents = graph.seen, graph.parents
    seen[start] = None
    parents.append(0)
    level = [start]
    index = transitions = 0
    pause = due = often(network)
    steps, plain, casts = network.steps, network.plain, network.casts
    while level:
        following: list[int] = []
        add, note = following.append, parents.append
        for state in level:
            present = network.present(state)
            moved = False
            known = None
            total = 0
            for place, _ in present:
                if steps[place] is None:
                    network.row(place)
                    graph.first[place] = index
                for change in plain[place]:
                    moved = True
                    transitions += 1
                    new = state + change
                    if new not in seen:
                        seen[new] = None
                        note(index)
                        add(new)
                for change, shifts, sends, sender in casts[place]:
                    moved = True
                    transitions += 1
                    if shifts is not known:
                        known = shifts
                        total = 0
                        for where, count in present:
                            shift = shifts.get(where)
                            if shift is None:
                                shift = network.shift_of(where, sends, sender)
                            if shift:
                                total += count * shift
                    new = state + change + total - shifts[place]
                    if new not in seen:
                        seen[new] = None
                        note(index)
                        add(new)
            for step in network.risks(present):
                transitions += 1
                new = network.after(state, step)
                if new not in seen:
                    seen[new] = None
                    note(index)
                    add(new)
            if not moved:
                graph.stuck.append(index)
            index += 1
            if index + transitions >= due:
                due = index + transitions + pause
                if not budget.allows(len(seen)):
                    graph.transitions = transitions
                    return graph
        if len(seen) > budget.most:
            graph.transitions = transitions
            return graph
        level = following
    graph.transitions = transitions
    graph.complete = not network.cut
    return graph


def observe(network: Network, observer: Observer, budget: Budget) -> Graph:
    """Find the states of a swarm with an observer, until it sees a violation."""
    graph = Graph(network)
    seen, parents = graph.seen, graph.parents
    first = observer.start(network.start())
    seen[first] = None
    parents.append(0)
    if observer.is_bad(first):
        graph.bad = 0
        return graph
    level = [first]
    index = 0
    pause = due = often(network)
    while level:
        following: list[int] = []
        for state in level:
            moved = False
            if not observer.is_settled(state):
                for news, is_risk in (
                    (observer.following(state), False),
                    (observer.risking(state), True),
                ):
                    for new in news:
                        graph.transitions += 1
                        if new not in seen:
                            seen[new] = None
                            parents.append(index)
                            following.append(new)
                            if observer.is_bad(new):
                                graph.bad = len(seen) - 1
                                return graph
                        moved = moved or (new != state and not is_risk)
                if not moved and observer.fails_at_end(state) and not observer.is_busy(state):
                    graph.bad = index
                    return graph
            index += 1
            if index + graph.transitions >= due:
                due = index + graph.transitions + pause
                if not budget.allows(len(seen)):
                    return graph
        if len(seen) > budget.most:
            return graph
        level = following
    graph.complete = not network.cut
    return graph


def follow(network: Network, budget: Budget) -> Graph:
    """Find all states of a swarm, also those to which only time leads."""
    graph = Graph(network)
    seen, parents = graph.seen, graph.parents
    start = network.start()
    seen[start] = None
    parents.append(0)
    todo = [start]
    pause, due = often(network), 0
    for index, state in enumerate(todo):
        for new, _ in network.followers(state):
            graph.transitions += 1
            if new not in seen:
                seen[new] = None
                parents.append(index)
                todo.append(new)
        if len(seen) > budget.most:
            return graph
        if index + graph.transitions >= due:
            due = index + graph.transitions + pause
            if not budget.allows(len(seen)):
                return graph
    graph.complete = not network.cut
    return graph
