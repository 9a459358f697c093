"""Search of a swarm with the moves of a plan that leads to a violation.

A plan supposes that what a robot does takes nothing away: it stays in each state that it has been
in, and messages stay where they have arrived (the relaxed plan of J. Hoffmann and B. Nebel, The FF
Planning System, JAIR 14, 2001). Few moves are left of a large swarm so. A run of these alone may be
impossible, but if there is one, it is a run of the swarm.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from heapq import heappop, heappush
from typing import NamedTuple, Protocol

from swarmdsl.execution.verify.automata.labels import Move
from swarmdsl.execution.verify.automata.limits import Budget
from swarmdsl.execution.verify.properties.observer import Observer
from swarmdsl.execution.verify.search.explore import Graph, often
from swarmdsl.execution.verify.swarm.network import Network

_OFTEN = 256
"""Number of facts between two looks at the limits."""

Planned = tuple[int, int, Move]
"""A move of a group in a state."""


class Watched(Protocol):
    """Steps of the robot that a property is about, with the memory of the monitor."""

    def start(self) -> tuple[int, int]:
        """Return the first state, with the memory of the monitor."""

    def steps(self, state: int, memory: int, message: int | None) -> Iterable[tuple[Move, int]]:
        """Yield moves on a message, or without one, each with the memory after it."""

    def is_bad(self, memory: int) -> bool:
        """Return True if the property is violated."""


class _Fact(NamedTuple):
    """A robot of a group has been in a state, or a message has arrived at it."""

    group: int
    state: int = -1
    memory: int = 0
    message: int = -1


class _Support(NamedTuple):
    """A move that makes a fact true, and the facts that it needs."""

    group: int
    state: int
    move: Move
    needs: tuple[_Fact, ...]


class _Plan:
    """Facts in the order of their costs: the sum of the moves to all that each needs."""

    def __init__(self, network: Network, me: int, watched: Watched) -> None:
        self._network = network
        self._groups = network.groups
        self._me = me
        self._watched = watched
        self._todo: list[tuple[int, int, _Fact, _Support | None]] = []
        self._costs: dict[_Fact, int] = {}
        self._supports: dict[_Fact, _Support | None] = {}
        self._states: list[list[_Fact]] = [[] for _ in network.groups]
        self._messages: list[list[_Fact]] = [[] for _ in network.groups]

    def moves(self, budget: Budget) -> set[Planned]:
        """Return the moves that lead to a violation; none if no moves do, or at a limit."""
        for number, group in enumerate(self._groups):
            first = group.automaton.first
            start = (first.target, 0) if number != self._me else self._watched.start()
            self._add(0, _Fact(number, *start), None)
            self._send(0, number, first.sends, None)
        while self._todo:
            cost, _, fact, support = heappop(self._todo)
            if fact in self._costs:
                continue
            self._costs[fact] = cost
            self._supports[fact] = support
            if fact.group == self._me and fact.message < 0 and self._watched.is_bad(fact.memory):
                return self._to(fact)
            if fact.message < 0:
                self._states[fact.group].append(fact)
                self._follow(fact, None)
                for message in self._messages[fact.group]:
                    self._follow(fact, message)
            else:
                self._messages[fact.group].append(fact)
                for state in self._states[fact.group]:
                    self._follow(state, fact)
            if not len(self._costs) % _OFTEN and not budget.allows(len(self._costs)):
                break
        return set()

    def _follow(self, at: _Fact, message: _Fact | None) -> None:
        """Add what a robot in a state can do, with a message or of itself."""
        needs = (at,) if message is None else (at, message)
        cost = 1 + sum(self._costs[each] for each in needs)
        for move, memory in self._moves(at, None if message is None else message.message):
            if not self._network.is_looked_at(move):
                continue
            support = _Support(at.group, at.state, move, needs)
            self._add(cost, _Fact(at.group, move.target, memory), support)
            self._send(cost, at.group, move.sends, support)

    def _moves(self, at: _Fact, message: int | None) -> Iterable[tuple[Move, int]]:
        if at.group == self._me:
            return self._watched.steps(at.state, at.memory, message)
        automaton = self._groups[at.group].automaton
        if message is None:
            return [(move, 0) for move in automaton.moves(at.state) or ()]
        return [(move, 0) for move in automaton.moves_on(at.state, message)]

    def _send(
        self, cost: int, sender: int, messages: Sequence[int], support: _Support | None
    ) -> None:
        for message in messages:
            for number, group in enumerate(self._groups):
                if group.hears(message, self._groups[sender]):
                    self._add(cost, _Fact(number, message=message), support)

    def _add(self, cost: int, fact: _Fact, support: _Support | None) -> None:
        if fact not in self._costs:
            heappush(self._todo, (cost, len(self._todo), fact, support))

    def _to(self, goal: _Fact) -> set[Planned]:
        """Return the moves on which a fact depends."""
        found: set[Planned] = set()
        todo, seen = [goal], {goal}
        for fact in todo:
            support = self._supports[fact]
            if support is not None:
                found.add((support.group, support.state, support.move))
                todo += [each for each in support.needs if each not in seen]
                seen.update(support.needs)
        return found


def observe_planned(observer: Observer, me: int, watched: Watched, budget: Budget) -> Graph:
    """Look for a violation by the robot of a group, with the moves of a plan."""
    network = observer.network
    graph = Graph(network)
    seen, parents = graph.seen, graph.parents
    first = observer.start(network.start())
    seen[first] = None
    parents.append(0)
    todo = [first]
    moves = _Plan(network, me, watched).moves(budget)
    pause, due = often(network), 0
    for number, state in enumerate(todo):
        for new, step in observer.successors(state):
            graph.transitions += 1
            place = network.places[step.place]
            if step.move is None or (place.group, place.state, step.move) not in moves:
                continue
            if new in seen:
                continue
            seen[new] = None
            parents.append(number)
            todo.append(new)
            if observer.is_bad(new):
                graph.bad = len(seen) - 1
                return graph
        if len(seen) > budget.most:
            return graph
        if number + graph.transitions >= due:
            due = number + graph.transitions + pause
            if not budget.allows(len(seen)):
                return graph
    return graph
