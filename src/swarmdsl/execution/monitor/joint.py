"""Joint automata of the sentences about each robot of a role and nothing else.

A robot takes one step in all of them together, which is found with one look into a table. They are
made from the automata of the sentences as runs need them; all robots of a role, and all runs, share
them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from .automaton import Move, State
from .rule import Rule

Bits = Sequence[int]
"""Bits of facts, one by one."""
MOST_STANDS = 20_000
"""Number of states that a joint automaton keeps."""


class Leap:
    """Step of a robot in all sentences.

    `facts` change with it, or are those of what happens now, its `moment`, or happened at the last
    step; `different` leaves out what is over. `gained` and `lost` are those of which the number of
    robots matters. `moves` are steps of automata that matter at once, by the numbers of sentences,
    `silent` the other states that automata go to.
    """

    __slots__ = (
        "counts",
        "different",
        "facts",
        "gained",
        "lost",
        "moment",
        "moves",
        "silent",
        "target",
    )

    def __init__(self, facts: int, different: int, moment: int) -> None:
        self.facts = facts
        self.different = different
        self.moment = moment
        self.gained: Sequence[int] = ()
        self.lost: Sequence[int] = ()
        self.counts = False
        """True if some are gained or lost."""
        self.moves: list[tuple[int, Move]] = []
        self.silent: list[tuple[int, State]] = []
        self.target: Stand


class Stand:
    """Facts that hold for a robot, and the states of the sentences about it.

    `leaps` are the known steps, by the facts that hold after them.
    """

    __slots__ = ("bits", "leaps", "states")

    def __init__(self, bits: int, states: tuple[State, ...]) -> None:
        self.bits = bits
        self.states = states
        self.leaps: dict[int, Leap] = {}


class Joint:
    """Joint automaton of the sentences about each robot of a role, which have these numbers."""

    def __init__(
        self, rules: Sequence[tuple[int, Rule]], momentary: int, shared: Callable[[int], Bits]
    ) -> None:
        self.numbers = [number for number, _ in rules]
        self._rules = rules
        self._momentary = momentary
        self._shared = shared
        self._stands: dict[tuple[int, tuple[State, ...]], Stand] = {}

    def at(self, bits: int, states: tuple[State, ...]) -> Stand:
        """Return the place of a robot with these facts and states."""
        found = self._stands.get((bits, states))
        if found is None:
            if len(self._stands) >= MOST_STANDS:
                for each in self._stands.values():
                    each.leaps.clear()
                self._stands.clear()
            found = self._stands[bits, states] = Stand(bits, states)
        return found

    def leap(self, stand: Stand, bits: int, more: int = 0) -> Leap:
        """Return the step after which these facts hold; it is also about some `more`."""
        before = stand.bits
        over = before & self._momentary
        different = (before ^ over ^ bits) | more
        stepped = self._about(over | different)
        found = Leap(over | different, different, bits & self._momentary)
        found.gained, found.lost = self._shared(bits & ~before), self._shared(before & ~bits)
        found.counts = bool(found.gained or found.lost)
        states = []
        for (number, rule), state in zip(self._rules, stand.states, strict=True):
            target = state
            if number in stepped:
                key = bits & rule.claims.own
                move = state.moves.get(key) or rule.move(state, key)
                target = move.target
                if move is not state.stay and _is_silent(rule, state, move):
                    found.silent.append((number, target))
                elif move is not state.stay:
                    found.moves.append((number, move))
            states.append(target)
        found.target = self.at(bits, tuple(states))
        if not more:
            stand.leaps[bits] = found
        return found

    def _about(self, facts: int) -> Sequence[int]:
        """Return the numbers of the sentences that some facts can change."""
        return [number for number, rule in self._rules if rule.claims.mask & facts]


def _is_silent(rule: Rule, state: State, move: Move) -> bool:
    """Return True if a step changes no verdict for good and no clock."""
    target = move.target
    if move.begins or target.is_violated or rule.automaton.is_final(target):
        return False
    return target.is_timed or not state.is_timed
