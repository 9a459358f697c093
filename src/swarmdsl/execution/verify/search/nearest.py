"""Search of a swarm where one of its robots is nearest to violating a property."""

from __future__ import annotations

from collections.abc import Mapping
from heapq import heappop, heappush

from swarmdsl.execution.verify.automata.limits import Budget
from swarmdsl.execution.verify.properties.observer import Observer
from swarmdsl.execution.verify.search.explore import Graph, often


def observe_nearest(
    observer: Observer, me: int, distances: Mapping[tuple[int, int], int], budget: Budget
) -> Graph:
    """Look for a violation by the robot of a group, first where it has the fewest steps to it.

    The distances are by its state and the memory of the monitor. From a state without one, no run
    violates the property any more.
    """
    network = observer.network
    graph = Graph(network)
    seen, parents = graph.seen, graph.parents

    def distance_of(state: int) -> int | None:
        own = next(
            network.places[place].state
            for place, _ in network.present(state)
            if network.places[place].group == me
        )
        return distances.get((own, state & observer.mine))

    first = observer.start(network.start())
    seen[first] = None
    parents.append(0)
    todo = [(0, 0, first)]
    turns = 0
    pause = due = often(network)
    while todo:
        _, number, state = heappop(todo)
        for news in (observer.following(state), observer.risking(state)):
            for new in news:
                graph.transitions += 1
                if new in seen:
                    continue
                seen[new] = None
                parents.append(number)
                if observer.is_bad(new):
                    graph.bad = len(seen) - 1
                    return graph
                distance = distance_of(new)
                if distance is not None:
                    heappush(todo, (distance, len(seen) - 1, new))
        turns += 1
        if len(seen) > budget.most:
            return graph
        if turns + graph.transitions >= due:
            due = turns + graph.transitions + pause
            if not budget.allows(len(seen)):
                return graph
    return graph
