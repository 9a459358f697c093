"""Guards and effects without a value, and machines that do not come to rest, each with a run."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from functools import partial

from swarmdsl.base.records import dataclass, field, replace
from swarmdsl.execution.verify.automata.labels import Move
from swarmdsl.execution.verify.automata.limits import Budget
from swarmdsl.execution.verify.findings.finding import Finding
from swarmdsl.execution.verify.findings.reached import place_of_change
from swarmdsl.execution.verify.search.explore import Graph
from swarmdsl.execution.verify.search.run import Run
from swarmdsl.execution.verify.swarm.groups import Group

MOST_RUNS = 20
"""Number of runs to one fault that are tried on the engine."""

Key = tuple[str, str, str]
"""Fault, machine, and reason: one of each is reported."""


@dataclass
class Failures:
    """Faults that runs show, and the flaws of the runs to those that none shows."""

    found: dict[Key, Finding] = field(default_factory=dict)
    flaws: dict[Key, tuple[Finding, str]] = field(default_factory=dict)

    def add(self, others: Failures) -> None:
        """Add what runs of another search show, if it was open."""
        for key in [key for key in self.flaws if key in others.found]:
            self.found[key] = others.found[key]
            del self.flaws[key]


def failures(
    graph: Graph, budget: Budget, begun: Callable[[], Run], played: Callable[[int, Move], Run]
) -> Failures:
    """Find faults in the moves of robots.

    After the limits, one run to each fault is tried, as long as the budget spares a moment.

    `begun` returns a run of their start, `played` one to a place, and a move there.
    """
    result = Failures()
    tried: Counter[Key] = Counter()
    network = graph.network

    def show(group: Group, move: Move, run_of: Callable[[], Run]) -> None:
        for key, fault in _faults(group, move):
            if key in result.found or tried[key] == MOST_RUNS:
                continue
            if not (budget.spares_a_moment() if not tried[key] else budget.allows(0)):
                continue
            tried[key] += 1
            run = run_of()
            if run.flaw:
                result.flaws.setdefault(key, (fault, run.flaw))
            else:
                result.found[key] = replace(fault, run=run)

    for group in network.groups:
        show(group, group.automaton.first, begun)
    for number in sorted(graph.first, key=graph.first.__getitem__):
        group = network.groups[network.places[number].group]
        for step in network.row(number):
            if step.move is not None:
                show(group, step.move, partial(played, number, step.move))
    for key in result.found:
        result.flaws.pop(key, None)
    return result


def _faults(group: Group, move: Move) -> Iterator[tuple[Key, Finding]]:
    """Yield what goes wrong in a move, without a run."""
    for moment in move.moments:
        machine = group.automaton.whole.kind.cast[moment.actor].machine
        place = place_of_change(machine, moment)
        if moment.loops:
            key = ("loops", machine.name, "")
            yield key, Finding("loops", machine.name, group.role, place)
        for reason in moment.failures:
            key = ("fails", machine.name, reason)
            yield key, Finding("fails", machine.name, group.role, place, reason)
