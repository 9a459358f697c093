"""Search for runs that go on for ever: a way to a loop, and the loop.

In a loop, a property stays open, and all that is running is over some time. It is in a strongly
connected component (R. Tarjan, 1972) of the states in which the property is open.
"""

from __future__ import annotations

from array import array
from collections import deque
from collections.abc import Callable, Iterator, Sequence

from swarmdsl.base.records import dataclass
from swarmdsl.execution.verify.automata.limits import Budget, LimitReachedError
from swarmdsl.execution.verify.properties.observer import Observer
from swarmdsl.execution.verify.search.explore import Graph
from swarmdsl.execution.verify.search.fairness import Fairness
from swarmdsl.execution.verify.search.run import steps_between
from swarmdsl.execution.verify.swarm.groups import Step

_OFTEN = 256
"""Number of states between two looks at the time."""
_MOST_BEGINNINGS, _MOST_LOOPS = 12, 4
"""Maximum number of states of a component in which loops begin, twice, and of these loops."""
_MOST_FOLLOWING = 10_000
"""Maximum number of states whose steps are kept."""
_Delay = tuple[int, int, str]
"""Delay of the robots of a group: group, machine, and timer."""


@dataclass(frozen=True)
class Lasso:
    """Steps to a loop and steps of the loop; without these, nothing happens any more."""

    stem: list[Step]
    loop: list[Step]


class Lassos:
    """Fair runs of a graph in which a property stays open for ever.

    `complete` is False if the search came to a limit.
    """

    def __init__(self, graph: Graph, observer: Observer, budget: Budget) -> None:
        self.complete = True
        self._graph = graph
        self._observer = observer
        self._budget = budget
        self._fairness = Fairness(observer.network)
        self._following: dict[int, list[tuple[int, Step]]] = {}
        """Steps of some states: loops from several states of a component share them."""
        self._states: list[int] = []
        """States in which the property is open, in the order of their distance from the start."""
        self._numbers: dict[int, int] = {}
        self._where: list[int] = []
        """Their numbers in the graph."""
        self._asked = 0

    def __iter__(self) -> Iterator[Lasso]:
        """Yield lassos, those first at whose ends nothing happens."""
        try:
            for each in self._found():
                yield each
                self._budget.check()
        except LimitReachedError:
            self.complete = False

    def _found(self) -> Iterator[Lasso]:
        for number, state in enumerate(self._graph.seen):
            if not number % _OFTEN:
                self._budget.check()
            if self._observer.is_open(state & self._observer.mine):
                self._numbers[state] = len(self._states)
                self._states.append(state)
                self._where.append(number)
        for number, state in enumerate(self._states):
            if not number % _OFTEN:
                self._budget.check()
            if not self._fairness.running(state):
                yield Lasso(self._stem(number), [])
        for component in self._components():
            found = self._fair_lassos(component)
            yield from found
            # The parts of an unfair component are unfair, too.
            for delay in self._delays(component) if found else ():
                # Loops without the end of a delay, which may end too early in others.
                for part in self._components(component, delay):
                    yield from self._fair_lassos(part, delay)

    def _steps(self, number: int, without: _Delay | None = None) -> list[tuple[int, Step]]:
        """Return the states to which a step leads while the property stays open."""
        self._asked += 1
        if not self._asked % _OFTEN:
            self._budget.check()
        found = self._following.get(number)
        if found is None:
            found = [
                (self._numbers[after], step)
                for after, step, passed in self._observer.passing(self._states[number])
                if after in self._numbers and all(map(self._observer.is_open, passed))
            ]
            if len(self._following) < _MOST_FOLLOWING:
                self._following[number] = found
        if without is None:
            return found
        return [each for each in found if self._delay(each[1]) != without]

    def _delay(self, step: Step) -> _Delay | None:
        """Return the delay that ends at a step."""
        if step.move is None or step.move.given.kind != "time":
            return None
        group = self._observer.network.places[step.place].group
        return (group, step.move.given.actor, step.move.given.name)

    def _delays(self, component: Sequence[int]) -> list[_Delay]:
        """Return the delays that end in a component."""
        found = (self._delay(step) for number in component for _, step in self._steps(number))
        return list(dict.fromkeys(each for each in found if each is not None))

    def _components(
        self, among: Sequence[int] | None = None, without: _Delay | None = None
    ) -> list[list[int]]:
        """Return the components in which there are loops, those that are nearest first."""
        nodes = range(len(self._states)) if among is None else among
        numbers = {node: number for number, node in enumerate(nodes)}
        starts = array("I", [0])
        targets = array("I")
        for node in nodes:
            after = dict.fromkeys(numbers.get(each) for each, _ in self._steps(node, without))
            targets.extend(each for each in after if each is not None)
            starts.append(len(targets))
        found = [
            sorted(nodes[each] for each in component)
            for component in components(starts, targets, self._budget.check)
            if len(component) > 1
            or component[0] in targets[starts[component[0]] : starts[component[0] + 1]]
        ]
        return sorted(found)

    def _is_fair(self, component: Sequence[int], without: _Delay | None) -> bool:
        """Return True if all that is running in a component may be over in it."""
        inside = set(component)
        running = -1
        over = 0
        for number in component:
            running &= self._fairness.running(self._states[number])
            for after, step in self._steps(number, without):
                if after in inside:
                    over |= self._fairness.over(self._states[number], step)
            if not running & ~over:
                return True
        return False

    # ---- one run

    def _stem(self, number: int) -> list[Step]:
        self._budget.check()
        way = self._graph.way(self._where[number])
        return steps_between(way, lambda state: list(self._observer.successors(state)))

    def _fair_lassos(self, component: Sequence[int], without: _Delay | None = None) -> list[Lasso]:
        """Return some fair loops of a component, the shortest runs first.

        They begin in the nearest states, and in some of all others.
        """
        if not self._is_fair(component, without):
            return []
        inside = set(component)
        some = component[:: len(component) // _MOST_BEGINNINGS + 1]
        found = []
        for first in dict.fromkeys((*component[:_MOST_BEGINNINGS], *some)):
            found.append(Lasso(self._stem(first), self._loop(first, inside, without)))
        found.sort(key=lambda lasso: len(lasso.stem) + len(lasso.loop))
        return found[:_MOST_LOOPS]

    def _loop(self, first: int, inside: set[int], without: _Delay | None) -> list[Step]:
        """Return a fair loop: the way to the next step that ends something, until all is over."""
        loop: list[Step] = []
        now = first
        left = self._fairness.running(self._states[first])
        while left:
            steps, now, left = self._next(now, inside, left, without)
            loop += steps
        if now != first or not loop:
            loop += self._back(now, first, inside, without)
        return loop

    def _next(
        self, first: int, inside: set[int], left: int, without: _Delay | None
    ) -> tuple[list[Step], int, int]:
        """Return the shortest way on after which less is left, where it ends, and what is left."""
        before: dict[int, tuple[int, Step]] = {}
        todo = deque([first])
        seen = {first}
        while todo:
            number = todo.popleft()
            for after, step in self._steps(number, without):
                if after not in inside:
                    continue
                over = self._fairness.over(self._states[number], step)
                rest = left & ~over & self._fairness.running(self._states[after])
                if rest != left:
                    return [*_way(first, number, before), step], after, rest
                if after not in seen:
                    seen.add(after)
                    before[after] = (number, step)
                    todo.append(after)
        raise AssertionError("in a fair component, all that is running may be over")

    def _back(self, last: int, first: int, inside: set[int], without: _Delay | None) -> list[Step]:
        """Return the shortest way from a state to another one, of a step at least."""
        before: dict[int, tuple[int, Step]] = {}
        todo = deque([last])
        seen = {last}
        while todo:
            number = todo.popleft()
            for after, step in self._steps(number, without):
                if after == first:
                    return [*_way(last, number, before), step]
                if after in inside and after not in seen:
                    seen.add(after)
                    before[after] = (number, step)
                    todo.append(after)
        raise AssertionError("a way leads from each state of a component to each other one")


def _way(first: int, last: int, before: dict[int, tuple[int, Step]]) -> list[Step]:
    steps = []
    while last != first:
        last, step = before[last]
        steps.append(step)
    return steps[::-1]


def components(
    starts: Sequence[int], targets: Sequence[int], check: Callable[[], None]
) -> Iterator[list[int]]:
    """Yield the strongly connected components of a graph.

    The edges of node `n` lead to the nodes from `starts[n]` to `starts[n + 1]` in `targets`.
    `check` is called now and then, and may raise an exception.
    """
    count = len(starts) - 1
    index = array("I", bytes(4 * count))
    low = array("I", bytes(4 * count))
    on_stack = bytearray(count)
    stack: list[int] = []
    clock = 0
    for root in range(count):
        if index[root]:
            continue
        path = [(root, starts[root])]
        clock += 1
        index[root] = low[root] = clock
        stack.append(root)
        on_stack[root] = 1
        while path:
            if not clock % _OFTEN:
                check()
            node, edge = path.pop()
            if edge < starts[node + 1]:
                path.append((node, edge + 1))
                other = targets[edge]
                if not index[other]:
                    clock += 1
                    index[other] = low[other] = clock
                    stack.append(other)
                    on_stack[other] = 1
                    path.append((other, starts[other]))
                elif on_stack[other]:
                    low[node] = min(low[node], index[other])
                continue
            if path:
                parent = path[-1][0]
                low[parent] = min(low[parent], low[node])
            if low[node] == index[node]:
                found = []
                while True:
                    each = stack.pop()
                    on_stack[each] = 0
                    found.append(each)
                    if each == node:
                        break
                yield found
