"""Search for runs in which a swarm comes to rest while a property is open.

In a large swarm, a search by distance from the start does not come to where all that is running is
over. This one goes on first from states in which little is running, and adds nothing from outside.
Messages arrive before functions end, and these before delays, wherever that is possible: most runs
in another order fit no times (a limited discrepancy search, W. Harvey and M. Ginsberg, 1995).
"""

from __future__ import annotations

from collections import deque
from heapq import heappop, heappush

from swarmdsl.execution.verify.automata.limits import Budget
from swarmdsl.execution.verify.properties.observer import Observer
from swarmdsl.execution.verify.search.explore import Graph, often
from swarmdsl.execution.verify.search.fairness import Fairness
from swarmdsl.execution.verify.swarm.groups import Step

_MOST_STEPS = 200_000
"""Number of steps after which the search ends: states of a large swarm have many."""
_FOREIGN = ("outside", "view", "lose")
"""Inputs that do not come by themselves."""


def observe_settling(observer: Observer, budget: Budget) -> Graph:
    """Find states near the start, and from those in which a property is open the way to rest.

    A state in which the property is violated ends the search.
    """
    search = _Search(observer)
    search.run(budget)
    return search.graph


class _Search:
    def __init__(self, observer: Observer) -> None:
        self.graph = Graph(observer.network)
        self._observer = observer
        self._fairness = Fairness(observer.network)
        self._states: list[int] = []
        self._detours: list[int] = []
        """Number of steps on the way to each state that were out of turn, or came from outside
        while the property was open."""
        self._near: deque[int] = deque()
        self._restless: list[tuple[int, int, int, int]] = []
        """States in which the property is open: detours, what is running, the number before,
        negated to go on from the last one, and the own number."""

    def run(self, budget: Budget) -> None:
        """Follow in turn the nearest state, and the one that seems nearest to rest."""
        observer = self._observer
        self._add(observer.start(observer.network.start()), 0, 0)
        turns = 0
        pause = due = often(observer.network)
        while self._near and self.graph.bad is None:
            self._follow(self._near.popleft(), by_itself=False)
            if self._restless:
                self._follow(heappop(self._restless)[-1], by_itself=True)
            turns += 1
            if turns + self.graph.transitions >= due:
                due = turns + self.graph.transitions + pause
                if not budget.allows(len(self._states)):
                    break
            if len(self._states) > budget.most or self.graph.transitions > _MOST_STEPS:
                break

    def _follow(self, number: int, *, by_itself: bool) -> None:
        """Add the states after a state; with `by_itself`, without anything from outside."""
        state = self._states[number]
        if self._observer.is_settled(state):
            return
        is_open = self._observer.is_open(state & self._observer.mine)
        every = list(self._observer.successors(state))
        self.graph.transitions += len(every)
        first = min((step.turn for _, step in every if not _is_foreign(step)), default=0)
        # States keep the first way that leads to them: one without detour, if there is one.
        for after, step in sorted(every, key=lambda each: each[1].turn):
            if not (by_itself and _is_foreign(step)):
                is_detour = is_open if _is_foreign(step) else step.turn > first
                self._add(after, number, self._detours[number] + is_detour)

    def _add(self, state: int, parent: int, detours: int) -> None:
        graph, observer = self.graph, self._observer
        if state in graph.seen:
            return
        number = len(self._states)
        graph.seen[state] = None
        graph.parents.append(parent)
        self._states.append(state)
        self._detours.append(detours)
        self._near.append(number)
        if observer.is_bad(state):
            graph.bad = number
        elif observer.is_open(state & observer.mine):
            heappush(self._restless, (detours, self._fairness.load(state), -parent, number))


def _is_foreign(step: Step) -> bool:
    return step.move is not None and step.move.given.kind in _FOREIGN
