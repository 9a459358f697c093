"""Loops of answers: events that robots send to each other without end, though no time passes."""

from __future__ import annotations

from array import array
from collections import deque
from collections.abc import Iterator

from swarmdsl.base.records import replace
from swarmdsl.execution.verify.automata.limits import Budget
from swarmdsl.execution.verify.replay.lasso_replay import repeated
from swarmdsl.execution.verify.replay.play import play
from swarmdsl.execution.verify.search.explore import Graph
from swarmdsl.execution.verify.search.lassos import Lasso, components
from swarmdsl.execution.verify.search.run import Run, steps_between
from swarmdsl.execution.verify.swarm.groups import Step

_OFTEN = 256
"""Number of states between two looks at the time."""
_MOST_TRIES = 8


def livelock(graph: Graph, budget: Budget) -> tuple[Run, Step] | None:
    """Return a run that ends in a loop of answers, and the first step of the loop.

    Raises LimitReachedError.
    """
    loops = _Loops(graph, budget)
    for lasso in loops.find():
        budget.check()
        named = repeated(graph.network, lasso, fair=False)
        if isinstance(named, str):
            continue
        run = play(graph.network, named.stem + named.loop)
        if not run.flaw:
            before = play(graph.network, named.stem)
            return replace(run, loop=len(run.lines) - len(before.lines)), named.loop[0]
    return None


class _Loops:
    """Loops of the steps at which an event of a robot arrives."""

    def __init__(self, graph: Graph, budget: Budget) -> None:
        self._graph = graph
        self._budget = budget
        self._asked = 0
        self._network = graph.network
        self._answers: dict[int, bool] = {}

    def find(self) -> Iterator[Lasso]:
        """Yield shortest loops, the nearest ones first."""
        # Only robots that answer at once can go on so.
        if not any(map(self._can_answer, self._graph.first)):
            return
        numbers = {state: number for number, state in enumerate(self._graph.seen)}
        states = list(numbers)
        starts = array("I", [0])
        targets = array("I")
        for state in states:
            after = dict.fromkeys(numbers.get(after) for after, _ in self._steps(state))
            targets.extend(each for each in after if each is not None)
            starts.append(len(targets))
        found = [
            min(component)
            for component in components(starts, targets, self._budget.check)
            if len(component) > 1
            or component[0] in targets[starts[component[0]] : starts[component[0] + 1]]
        ]
        for number in sorted(found)[:_MOST_TRIES]:
            stem = steps_between(
                self._graph.way(number), lambda state: list(self._network.followers(state))
            )
            yield Lasso(stem, self._loop(states[number]))

    def _can_answer(self, place: int) -> bool:
        """Return True if a robot sends something when an event of a robot arrives."""
        moves = [step.move for step in self._network.row(place) if step.move is not None]
        return any(
            each.given.kind == "inside" or (each.given.kind == "hear" and each.sends)
            for each in moves
        )

    def _steps(self, state: int) -> Iterator[tuple[int, Step]]:
        self._asked += 1
        if not self._asked % _OFTEN:
            self._budget.check()
        network = self._network
        for place, _ in network.present(state):
            for step in network.row(place):
                if step.move is not None and step.move.given.kind in ("hear", "inside"):
                    yield network.after(state, step), step

    def _loop(self, first: int) -> list[Step]:
        """Return a shortest loop from a state."""
        before: dict[int, tuple[int, Step]] = {}
        todo = deque([first])
        while first not in before:
            state = todo.popleft()
            for after, step in self._steps(state):
                if after not in before:
                    before[after] = (state, step)
                    todo.append(after)
        steps: list[Step] = []
        state = first
        while not steps or state != first:
            state, step = before[state]
            steps.append(step)
        return steps[::-1]
