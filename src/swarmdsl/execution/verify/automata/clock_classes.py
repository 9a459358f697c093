"""States of a robot with clocks that no run can tell apart, as one.

What a robot does unseen at one moment leaves out nothing if it can do the same before and after it:
this is branching bisimilarity (R. van Glabbeek and W. P. Weijland, 1996), found by refinement of
signatures (S. Blom and S. Orzan, 2005).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from swarmdsl.execution.verify.automata.clocks import ClockedAutomaton
from swarmdsl.execution.verify.automata.labels import Look, Move
from swarmdsl.execution.verify.automata.quotient import numbered
from swarmdsl.execution.verify.robot.tasks import Task

MOST_STATES = 2_000
"""Maximum number of states of a robot with its clocks that are compared."""
_Edge = tuple[Any, int]
"""Label and target."""


def classes_of(inner: ClockedAutomaton, *, steps_count: bool) -> ClockClasses | None:
    """Return the classes of the states of a robot; None if it has too many states.

    If `steps_count`, a step that changes no fact is seen, too: it ends what held for a moment.
    """
    number = 0
    messages = range(len(inner.whole.alphabet.messages))
    heard = [each for each in messages if inner.whole.listens(each)]
    while number < inner.count:
        if inner.moves(number) is None or inner.count > MOST_STATES:
            return None
        inner.later(number)
        for message in heard:
            inner.moves_on(number, message)
        number += 1
    found = ClockClasses(inner, heard, steps_count=steps_count)
    if not steps_count and found.is_split:
        return ClockClasses(inner, heard, steps_count=True)
    return found


class ClockClasses:
    """Automaton of the classes of all states of a robot with clocks."""

    def __init__(self, inner: ClockedAutomaton, heard: Sequence[int], *, steps_count: bool) -> None:
        self.whole = inner.whole
        self.mask = inner.mask
        self.inner = inner
        self._heard = heard
        self._steps_count = steps_count
        self.classes: Sequence[int] = self._stable()
        self.count = len(set(self.classes))
        self._members: list[list[int]] = [[] for _ in range(self.count)]
        for state, number in enumerate(self.classes):
            self._members[number].append(state)
        self.first = inner.first._replace(target=self.classes[inner.first.target])
        self._moves: dict[int, list[Move]] = {}
        self._moves_on: dict[tuple[int, int], list[Move]] = {}
        self._later = [self._ticks(members) for members in self._members]
        self.is_split = any(len(each) > 1 for each in self._later)
        """True if a tick leads from a class to several ones, which a network does not cover."""

    def later(self, number: int) -> int | None:
        """Return the state a tick later; None if something must happen before."""
        return next(iter(self._later[number]), None)

    def moves(self, state: int) -> list[Move] | None:
        """Return the moves of a state; of those that are not seen, one that leads back to it."""
        if state not in self._moves:
            found: dict[Any, Move] = {}
            for member in self._members[state]:
                for move in self.inner.moves(member) or ():
                    found.setdefault(self._key(member, move), self._lifted(move))
            self._moves[state] = list(found.values())
        return self._moves[state]

    def moves_on(self, state: int, message: int) -> list[Move]:
        """Return the moves of a state when a message arrives."""
        key = (state, message)
        if key not in self._moves_on:
            found: dict[Any, Move] = {}
            for member in self._members[state]:
                for move in self.inner.moves_on(member, message):
                    label = (self._label(move), self.classes[move.target])
                    found.setdefault(label, self._lifted(move))
            self._moves_on[key] = list(found.values())
        return self._moves_on[key]

    def is_late(self, state: int, message: int) -> bool:
        """Return True if a message stays on its way: enough of the same kind are deferred."""
        return self.inner.is_late(self._members[state][0], message)

    def follow(self, number: int, move: Move) -> Move:
        """Return the same move."""
        del number
        return move

    def loss(self, state: int) -> Move | None:
        """Return None: robots with clocks are not lost."""
        return self.inner.loss(self._members[state][0])

    def is_lost(self, state: int) -> bool:
        """Return False: robots with clocks are not lost."""
        return self.inner.is_lost(self._members[state][0])

    def look(self, state: int) -> Look:
        """Return what a state shows."""
        return self.inner.look(self._members[state][0])

    def tasks(self, state: int) -> frozenset[Task]:
        """Return what is running in a state."""
        return self.inner.tasks(self._members[state][0])

    def ended(self, state: int) -> bool:
        """Return True if the robot has ended."""
        return self.look(state).ended

    # ---- internal

    def _lifted(self, move: Move) -> Move:
        return move._replace(target=self.classes[move.target])

    def _ticks(self, members: Sequence[int]) -> dict[int, None]:
        later = map(self.inner.later, members)
        return dict.fromkeys(self.classes[each] for each in later if each is not None)

    def _label(self, move: Move) -> Any:
        shown = tuple(each.holding & self.mask for each in move.moments)
        return (shown, move.sends, move.idle if self._steps_count else None)

    def _key(self, state: int, move: Move) -> Any:
        """Return what tells a move from others of its class."""
        target = self.classes[move.target]
        if target == self.classes[state] and self._is_unseen(state, move):
            return move.idle
        return self._label(move), target

    def _is_unseen(self, state: int, move: Move) -> bool:
        lasting = self.inner.look(state).holding & self.mask
        silent = all(each.holding & self.mask == lasting for each in move.moments)
        return silent and not move.sends and not self._steps_count

    def _is_passive(self, state: int) -> bool:
        """Return True if nothing ever happens by itself: a run may end there."""
        moves = self.inner.moves(state) or ()
        stays = all(each.idle and each.target == state for each in moves)
        return stays and self.inner.later(state) == state

    def _stable(self) -> list[int]:
        """Return the class of each state, of the coarsest partition that is stable."""
        inner = self.inner
        states = range(inner.count)
        seen: list[list[_Edge]] = [list(self._edges(each)) for each in states]
        unseen: list[list[int]] = [
            [each.target for each in inner.moves(state) or () if self._is_unseen(state, each)]
            for state in states
        ]
        late = [frozenset(m for m in self._heard if inner.is_late(s, m)) for s in states]
        classes = numbered(
            [
                (inner.ended(s), inner.look(s).holding & self.mask, late[s], self._is_passive(s))
                for s in states
            ]
        )
        number = 0
        while number != len(set(classes)):
            number = len(set(classes))
            signs = [
                {(label, classes[target]) for label, target in seen[state]}
                | {(None, classes[t]) for t in unseen[state] if classes[t] != classes[state]}
                for state in states
            ]
            inert = [[t for t in unseen[s] if classes[t] == classes[s] and t != s] for s in states]
            _spread(signs, inert)
            classes = numbered([(classes[state], frozenset(signs[state])) for state in states])
        return classes

    def _edges(self, state: int) -> Iterator[_Edge]:
        """Yield what is seen of a state: moves, messages that arrive, and a tick."""
        for move in self.inner.moves(state) or ():
            if not self._is_unseen(state, move):
                yield ("move", self._label(move)), move.target
        for message in self._heard:
            for move in self.inner.moves_on(state, message):
                yield (message, self._label(move)), move.target
        later = self.inner.later(state)
        if later is not None:
            yield "tick", later


def _spread(signs: Sequence[set[Any]], inert: Sequence[Sequence[int]]) -> None:
    """Add to the signature of each state those of the states that it reaches unseen."""
    before: dict[int, list[int]] = {}
    for state, targets in enumerate(inert):
        for each in targets:
            before.setdefault(each, []).append(state)
    todo = list(before)
    while todo:
        target = todo.pop()
        for state in before.get(target, ()):
            if not signs[target] <= signs[state]:
                signs[state] |= signs[target]
                todo.append(state)
