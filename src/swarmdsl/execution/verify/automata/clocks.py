"""A robot with clocks: its states, with the time left of each running activity and delay.

Times are whole ticks (T. Henzinger, Z. Manna and A. Pnueli, What good are digital clocks?, 1992).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from swarmdsl.execution.verify.automata.automaton import Automaton
from swarmdsl.execution.verify.automata.labels import Look, Move
from swarmdsl.execution.verify.automata.slots import slot_of
from swarmdsl.execution.verify.robot.tasks import Task
from swarmdsl.execution.verify.robot.timing import Bounds

MOST_REPLAYS = 20_000
"""Number of runs of a robot from its start by which the moves of one that grows are found."""


class ClockedAutomaton:
    """Automaton of a kind of robot with a clock for each slot, found as a search needs it.

    A clock is the number of ticks after which its task can end, and after which it must, if any.
    `bounds` returns that of a function. Robots are told apart by the facts of `mask`. With `grow`,
    moves without clocks, too, are found as a search needs them, as long as it returns True.
    """

    def __init__(
        self,
        whole: Automaton,
        mask: int,
        tick: int,
        bounds: Callable[[str], Bounds],
        *,
        grow: Callable[[], bool] | None = None,
    ) -> None:
        self.whole = whole
        self.grows = grow is not None
        self._grow = grow
        self.mask = mask
        self._tick = tick
        self._bounds = bounds
        self._states: list[tuple[int, tuple[Bounds, ...]]] = []
        self._numbers: dict[tuple[int, tuple[Bounds, ...]], int] = {}
        self._moves: dict[int, list[Move]] = {}
        self._heard: dict[tuple[int, int], list[Move]] = {}
        self._later: dict[int, int | None] = {}
        self._slots: dict[tuple[int, int], int | None] = {}
        self.first = self._timed(whole.first, ())

    @property
    def classes(self) -> Sequence[int]:
        """The state that stands for each one: itself."""
        return range(len(self._states))

    @property
    def count(self) -> int:
        """Number of states that are known."""
        return len(self._states)

    def state(self, number: int) -> int:
        """Return the state of the robot without its clocks."""
        return self._states[number][0]

    def later(self, number: int) -> int | None:
        """Return the state a tick later; None if something must happen before."""
        if number not in self._later:
            self._later[number] = self._tick_of(number)
        return self._later[number]

    def moves(self, state: int) -> list[Move] | None:
        """Return the moves of a state, without those that come too early."""
        inner, clocks = self._states[state]
        if self.whole.steps[inner] is None and self._may_grow:
            self.whole.expand(inner)
        steps = self.whole.steps[inner]
        if steps is None:
            return None
        found = self._moves.get(state)
        if found is None:
            chosen: dict[object, Move] = {}
            for number, move in enumerate(steps):
                slot = self._slot(inner, number, move)
                if slot is None or clocks[slot][0] == 0:
                    timed = self._timed(move, clocks)
                    chosen.setdefault(self._label(timed), timed)
            found = self._moves[state] = list(chosen.values())
        return found

    def moves_on(self, state: int, message: int) -> list[Move]:
        """Return the moves of a state when a message arrives; none if they are not known."""
        key = (state, message)
        if key not in self._heard:
            inner, clocks = self._states[state]
            self._hear(inner, message)
            moves = self.whole.heard[inner].get(message, ())
            self._heard[key] = [self._timed(move, clocks) for move in moves]
        return self._heard[key]

    def is_late(self, state: int, message: int) -> bool:
        """Return True if a message stays on its way: enough of the same kind are deferred."""
        self._hear(self.state(state), message)
        return message in self.whole.late[self.state(state)]

    def follow(self, number: int, move: Move) -> Move:
        """Return the same move."""
        del number
        return move

    def loss(self, state: int) -> Move | None:
        """Return None: robots with clocks are not lost."""
        del state
        return None

    def is_lost(self, state: int) -> bool:
        """Return False: robots with clocks are not lost."""
        del state
        return False

    def look(self, state: int) -> Look:
        """Return what a state shows."""
        return self.whole.looks[self.state(state)]

    def tasks(self, state: int) -> frozenset[Task]:
        """Return what is running in a state."""
        return self.whole.tasks[self.state(state)]

    def ended(self, state: int) -> bool:
        """Return True if the robot has ended."""
        return self.look(state).ended

    # ---- internal

    @property
    def _may_grow(self) -> bool:
        return self._grow is not None and self.whole.replays < MOST_REPLAYS and self._grow()

    def _hear(self, inner: int, message: int) -> None:
        """Find what happens when a message arrives, if that is not known."""
        heard, late = self.whole.heard[inner], self.whole.late[inner]
        if message not in heard and message not in late and self._may_grow:
            self.whole.hear(inner, message)

    def _label(self, move: Move) -> object:
        """Return what tells moves of a state apart."""
        shown = tuple(each.holding & self.mask for each in move.moments)
        return (shown, move.idle, move.sends, move.target)

    def _slot(self, inner: int, number: int, move: Move) -> int | None:
        key = (inner, number)
        if key not in self._slots:
            self._slots[key] = slot_of(self.whole.slots[inner], move.given)
        return self._slots[key]

    def _timed(self, move: Move, clocks: Sequence[Bounds]) -> Move:
        after = tuple(
            clocks[each.source] if each.source is not None else self._new(slot.name, each.length)
            for slot, each in zip(self.whole.slots[move.target], move.carried, strict=True)
        )
        return move._replace(target=self._number(move.target, after))

    def _new(self, function: str, length: int | None) -> Bounds:
        if length is not None:
            assert length % self._tick == 0, "ticks measure all delays"
            return length // self._tick, length // self._tick
        least, most = self._bounds(function)
        return least // self._tick, most // self._tick if most is not None else None

    def _tick_of(self, number: int) -> int | None:
        inner, clocks = self._states[number]
        if any(most == 0 for _, most in clocks):
            return None
        if any(kind == "inside" for kind, _, _ in self.whole.tasks[inner]):
            return None
        after = tuple((max(least - 1, 0), most and most - 1) for least, most in clocks)
        return self._number(inner, after)

    def _number(self, inner: int, clocks: tuple[Bounds, ...]) -> int:
        key = (inner, clocks)
        found = self._numbers.get(key)
        if found is None:
            found = self._numbers[key] = len(self._states)
            self._states.append(key)
        return found
