"""States of an automaton that no run can tell apart, as one.

The coarsest partition is refined until it is stable (P. Kanellakis and S. Smolka, 1983). This
leaves out variables where they are not read any more.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from swarmdsl.execution.verify.automata.automaton import Automaton
from swarmdsl.execution.verify.automata.labels import Look, Move
from swarmdsl.execution.verify.robot.tasks import Task


class Quotient:
    """Automaton of which states that no run can tell apart are one.

    Runs tell apart the facts of `mask`, with `tasks` also what is running, and with `thorough`
    what findings are about: active states and transitions. `classes` has the state of the quotient
    for each of the automaton.
    """

    def __init__(self, whole: Automaton, mask: int, *, thorough: bool, tasks: bool = False) -> None:
        self.whole = whole
        self.mask = mask | whole.gone
        self._thorough = thorough
        self._has_tasks = tasks
        size = len(whole.steps)
        looks = [self._look(n) for n in range(size)]
        blocks = numbered(looks)
        count = -1
        while (found := max(blocks) + 1) != count:
            count = found
            blocks = numbered([(blocks[n], self._signature(n, blocks)) for n in range(size)])
        self.classes = blocks
        self._moves: dict[int, list[Move]] = {}
        self.count = count
        first: dict[int, int] = {}
        for number, block in enumerate(blocks):
            first.setdefault(block, number)
        self._representatives = [first[each] for each in range(count)]

    @property
    def first(self) -> Move:
        """Start of the robot."""
        return self._lifted(self.whole.first)

    def moves(self, state: int) -> list[Move] | None:
        """Return the moves of a state; None if they are not known."""
        found = self.whole.steps[self._representatives[state]]
        if found is None:
            return None
        if state not in self._moves:
            self._moves[state] = self._chosen(found)
        return self._moves[state]

    def moves_on(self, state: int, message: int) -> list[Move]:
        """Return the moves of a state when a message arrives; none if they are not known."""
        return self._chosen(self.whole.heard[self._representatives[state]].get(message, ()))

    def loss(self, state: int) -> Move | None:
        """Return the loss of the robot; None where it is lost, or cannot be."""
        found = self.whole.losses[self._representatives[state]]
        return None if found is None else self._lifted(found)

    def is_lost(self, state: int) -> bool:
        """Return True if the robot is lost."""
        return self.whole.is_lost[self._representatives[state]]

    def is_late(self, state: int, message: int) -> bool:
        """Return True if a message stays on its way: enough of the same kind are deferred."""
        return message in self.whole.late[self._representatives[state]]

    def follow(self, number: int, move: Move) -> Move:
        """Return the move of a state of the automaton that looks like one of the quotient."""
        if move.given.kind == "lose":
            loss = self.whole.losses[number]
            assert loss is not None, "robots in states that are one can be lost"
            return loss
        following: Sequence[Move] = self.whole.steps[number] or ()
        if move.given.kind == "hear":
            following = self.whole.heard[number][move.given.choice]
        return self._firsts(following)[self._label(move, move.target)]

    def look(self, state: int) -> Look:
        """Return what a state shows."""
        return self.whole.looks[self._representatives[state]]

    def tasks(self, state: int) -> frozenset[Task]:
        """Return what is running in a state, if this tells states apart."""
        return self.whole.tasks[self._representatives[state]]

    def ended(self, state: int) -> bool:
        """Return True if the robot has ended."""
        return self.look(state).ended

    def _chosen(self, found: Sequence[Move]) -> list[Move]:
        """Return one of all moves that nothing tells apart."""
        return [self._lifted(each) for each in self._firsts(found).values()]

    def _firsts(self, found: Sequence[Move]) -> dict[Any, Move]:
        """Return the first move in turn of those with the same label."""
        chosen: dict[Any, Move] = {}
        for move in found:
            label = self._label(move, self.classes[move.target])
            if label not in chosen or move.given.turn < chosen[label].given.turn:
                chosen[label] = move
        return chosen

    def _lifted(self, move: Move) -> Move:
        return move._replace(target=self.classes[move.target])

    def _look(self, number: int) -> Any:
        look = self.whole.looks[number]
        cut = number if self.whole.steps[number] is None else None
        lost = self.whole.is_lost[number]
        if self._thorough:
            return (cut, look, lost)
        tasks = self.whole.tasks[number] if self._has_tasks else None
        return (cut, look.ended, look.holding & self.mask, tasks, lost)

    def _label(self, move: Move, target: int) -> tuple[Any, ...]:
        given, moments, near = move.given, move.moments, move.supposes
        if self._thorough:
            return (given.kind, given.actor, given.name, moments, move.sends, target, near)
        shown = tuple(each.holding & self.mask for each in moments)
        ended = move.ended if self._has_tasks else None
        return (shown, move.idle, move.sends, target, ended, near)

    def _signature(self, number: int, blocks: Sequence[int]) -> Any:
        steps = self.whole.steps[number] or ()
        own = frozenset(self._label(each, blocks[each.target]) for each in steps)
        heard = tuple(
            (message, frozenset(self._label(each, blocks[each.target]) for each in moves))
            for message, moves in sorted(self.whole.heard[number].items())
        )
        loss = self.whole.losses[number]
        loses = None if loss is None else self._label(loss, blocks[loss.target])
        return own, heard, frozenset(self.whole.late[number]), loses


def numbered(keys: Sequence[Any]) -> list[int]:
    """Return for each key its number among different ones."""
    numbers: dict[Any, int] = {}
    return [numbers.setdefault(each, len(numbers)) for each in keys]
