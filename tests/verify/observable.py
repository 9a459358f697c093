"""Comparison of what can be seen of two models: is each run of the one also a run of the other?

An observer sees what arrives at a robot from outside and from other robots, and the states, sends,
calls and cancelled calls that follow, but no time, and not how a function ended. Robots are
compared one by one: each of them hears any message at any time.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.verify.automata.automaton import Automaton
from swarmdsl.execution.verify.automata.labels import Move
from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.swarm.model import Model, Options
from swarmdsl.ir import Swarm, System


class Views:
    """What can be seen of the robots of a swarm, by their numbers."""

    def __init__(self, system: System, swarm: Swarm) -> None:
        subject = Subject(swarm.name, system, swarm)
        self._model = Model(subject, {}, (), Options(), Budget(Limits()), Diagnostics())
        self.complete = self._model.complete
        self._steps: dict[tuple[int, int], list[tuple[Any, int]]] = {}

    def kinds(self) -> list[tuple[Any, int]]:
        """Return the automata with the robots that they are of."""
        return [(tuple(each.kind.robots), n) for n, each in enumerate(self._model.kinds)]

    def start(self, kind: int) -> tuple[Any, int]:
        """Return what can be seen of the start of a robot, and its state then."""
        automaton = self._model.kinds[kind]
        return self._label(automaton, automaton.first), automaton.first.target

    def steps(self, kind: int, state: int) -> list[tuple[Any, int]]:
        """Return the steps of a state: what can be seen of each, None if that is nothing."""
        if (kind, state) not in self._steps:
            automaton = self._model.kinds[kind]
            heard = chain(*automaton.heard[state].values())
            moves = (*(automaton.steps[state] or ()), *heard)
            self._steps[kind, state] = [
                (self._seen(automaton, state, move), move.target) for move in moves
            ]
        return self._steps[kind, state]

    def unheard(self, kind: int, other: Views, theirs: int) -> set[Any]:
        """Return what can arrive at a robot of mine, and at another one that has no use for it."""
        heard = self._model.kinds[kind]
        deaf = other._model.kinds[theirs]
        outside = {
            self._arrived(heard, name, number)
            for name, messages in heard.kind.outside.messages.items()
            for number in range(len(messages))
            if name not in deaf.kind.outside.messages
        }
        mine, sent = (each._model.alphabet.messages for each in (self, other))
        known = {self._message(n) for n in range(len(mine)) if heard.listens(n)}
        inside = {other._message(n) for n in range(len(sent)) if not deaf.listens(n)}
        return outside | known & inside

    def idle(self, kind: int, state: int, arrived: Any) -> Any:
        """Return what can be seen of a step in which something arrives, and nothing happens."""
        return arrived, (), (), (), self._model.kinds[kind].looks[state].innermost

    def closed(self, kind: int, states: Iterator[int] | set[int]) -> frozenset[int]:
        """Return some states, and those that follow in steps of which nothing can be seen."""
        found = set(states)
        todo = list(found)
        while todo:
            for label, target in self.steps(kind, todo.pop()):
                if label is None and target not in found:
                    found.add(target)
                    todo.append(target)
        return frozenset(found)

    def _seen(self, automaton: Automaton, state: int, move: Move) -> Any:
        label = self._label(automaton, move)
        entered = automaton.looks[state].innermost != automaton.looks[move.target].innermost
        return label if entered or any(label[:-1]) else None

    def _label(self, automaton: Automaton, move: Move) -> Any:
        given = move.given
        arrived: Any = None
        if given.kind == "outside":
            arrived = self._arrived(automaton, given.name, given.choice)
        elif given.kind == "hear":
            arrived = self._message(given.choice)
        return (
            arrived,
            tuple(name for each in move.moments for name in each.started),
            tuple(map(self._message, move.sends)),
            _cancelled(move),
            automaton.looks[move.target].innermost,
        )

    def _arrived(self, automaton: Automaton, name: str, number: int) -> Any:
        return name, repr(automaton.kind.outside.messages[name][number])

    def _message(self, number: int) -> Any:
        alphabet = self._model.alphabet
        event = alphabet.messages[number].event
        sender = event.envelope.sender if alphabet.demands.identity else None
        return event.name, repr(alphabet.shown(event)), event.envelope.to, sender


def _cancelled(move: Move) -> tuple[tuple[int, str], ...]:
    """Return the calls, by their machines and states, that a step ends before their time."""
    given = move.given
    by_itself = (given.actor, given.choice[0]) if given.kind == "end" else None
    calls = [(actor, str(state)) for kind, actor, state in move.ended if kind == "end"]
    return tuple(sorted(each for each in calls if each != by_itself))


def does_more(mine: Views, other: Views) -> bool:
    """Return True if a robot of another model has a run that none of my robots has.

    Also if one of them has too many states to tell.
    """
    if not (mine.complete and other.complete):
        return True
    by_robots = dict(mine.kinds())
    return any(
        robots not in by_robots or _differs(mine, by_robots[robots], other, kind)
        for robots, kind in other.kinds()
    )


def _differs(mine: Views, kind: int, other: Views, theirs: int) -> bool:
    (label, first), (seen, start) = mine.start(kind), other.start(theirs)
    if label != seen:
        return True
    unheard = mine.unheard(kind, other, theirs)
    begun = (start, mine.closed(kind, {first}))
    known, todo = {begun}, [begun]
    while todo:
        state, possible = todo.pop()
        idle = [(other.idle(theirs, state, each), state) for each in unheard]
        for label, target in (*other.steps(theirs, state), *idle):
            following = possible
            if label is not None:
                reached = {t for s in possible for seen, t in mine.steps(kind, s) if seen == label}
                following = mine.closed(kind, reached)
            if not following:
                return True
            if (target, following) not in known:
                known.add((target, following))
                todo.append((target, following))
    return False
