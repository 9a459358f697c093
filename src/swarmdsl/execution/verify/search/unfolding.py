"""Ways through the states of a swarm with clocks, for ways through classes of them."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from itertools import pairwise

from swarmdsl.execution.verify.automata.clock_classes import ClockClasses
from swarmdsl.execution.verify.properties.timed_observer import TimedObserver
from swarmdsl.execution.verify.swarm.groups import Group


def unfolded(group: Group) -> Group:
    """Return a group with all states of its robots."""
    automaton = group.automaton
    if isinstance(automaton, ClockClasses):
        automaton = automaton.inner
    return Group(automaton, group.robots)


def unfold(observer: TimedObserver, classes: TimedObserver, way: Sequence[int]) -> list[int]:
    """Return a way of an observer of unfolded groups along one of an observer of their classes."""
    found = [observer.start(observer.network.start())]
    for here, wanted in pairwise(way):
        found += _leg(observer, classes, found[-1], here, wanted)
    return found


def _leg(
    observer: TimedObserver, classes: TimedObserver, start: int, here: int, wanted: int
) -> list[int]:
    """Return the states after one, to the first of a class; those between are of the same class."""
    before: dict[int, int | None] = {start: None}
    todo = deque([start])
    while todo:
        state = todo.popleft()
        for after, _ in observer.successors(state):
            if after in before:
                continue
            before[after] = state
            class_ = _class_of(observer, classes, after)
            if class_ == wanted:
                leg = [after]
                while (last := before[leg[-1]]) is not None:
                    leg.append(last)
                return leg[-2::-1]
            if class_ == here:
                todo.append(after)
    raise AssertionError("states of a class can do the same")


def _class_of(observer: TimedObserver, classes: TimedObserver, state: int) -> int:
    """Return the class of a state of a swarm, with the same memory of the monitor."""
    network = classes.network
    found = state & observer.mine
    for number, count in observer.network.present(state):
        group, inner, bag = observer.network.places[number]
        automaton = network.groups[group].automaton
        if isinstance(automaton, ClockClasses):
            inner = automaton.classes[inner]
        found += count * network.ones[network.number(group, inner, bag)]
    return found
