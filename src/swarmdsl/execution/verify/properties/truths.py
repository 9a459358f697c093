"""Truths of the claims of a property in a state of a swarm, and at the moments of a move."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.execution.verify.automata.labels import Move
from swarmdsl.execution.verify.swarm.network import Network
from swarmdsl.execution.verify.swarm.propositions import Terms, Truth

_Sign = tuple[int, int, tuple[int, ...]]
"""Facts of a move: the group of the robot, its facts before, and at each moment."""


class Sight:
    """A state, of which the facts that hold are counted when they are asked for."""

    __slots__ = ("number", "present")

    def __init__(self, present: Sequence[tuple[int, int]]) -> None:
        self.present = present
        self.number = -1


class Truths:
    """Truths of claims, found once for all states in which as many robots show the same."""

    def __init__(
        self, network: Network, terms: Terms, claims: Sequence[Truth], me: int | None
    ) -> None:
        self._network = network
        self._terms = terms
        self._claims = claims
        self._me = me
        self._held: dict[int, list[int]] = {}
        """For each place, the facts that hold for its robots."""
        self._sights: dict[tuple[tuple[int, ...], tuple[int, ...]], int] = {}
        """Numbers of the counts of all facts, as they were met."""
        self._counts: list[tuple[tuple[int, ...], tuple[int, ...]]] = []
        self._now: list[tuple[bool, ...]] = []
        self._signs: dict[_Sign, int] = {}
        """Numbers of what moves show, as they were met."""
        self._every_sign: list[_Sign] = []
        self._after: dict[tuple[int, int], list[tuple[bool, ...]]] = {}

    def sign(self, place: int, move: Move) -> int:
        """Return the number of what a move at a place shows."""
        group = self._network.places[place].group
        sign = (group, self._lasting(place), tuple(each.holding for each in move.moments))
        found = self._signs.setdefault(sign, len(self._every_sign))
        if found == len(self._every_sign):
            self._every_sign.append(sign)
        return found

    def now(self, seen: Sight) -> tuple[bool, ...]:
        """Return the truths of the claims in a state."""
        number = seen.number if seen.number >= 0 else self._count(seen)
        return self._now[number]

    def after(self, sign: int, seen: Sight) -> list[tuple[bool, ...]]:
        """Return the truths of the claims at the moments of a move."""
        number = seen.number if seen.number >= 0 else self._count(seen)
        found = self._after.get((number, sign))
        if found is None:
            found = self._after[number, sign] = self._show(sign, number)
        return found

    def _count(self, seen: Sight) -> int:
        """Return the number of the counts of all facts in a state."""
        counts = [0] * len(self._terms)
        mine = [0] * len(self._terms)
        held, places = self._held, self._network.places
        for place, count in seen.present:
            terms = held.get(place)
            if terms is None:
                terms = held[place] = self._held_at(place)
            for term in terms:
                counts[term] += count
                if places[place].group == self._me:
                    mine[term] = 1
        key = (tuple(counts), tuple(mine))
        found = self._sights.get(key)
        if found is None:
            found = self._sights[key] = len(self._counts)
            self._counts.append(key)
            self._now.append(tuple(bool(each(*key)) for each in self._claims))
        seen.number = found
        return found

    def _held_at(self, place: int) -> list[int]:
        """Return the facts that hold for a robot at a place."""
        group, lasting = self._network.places[place].group, self._lasting(place)
        return [t for t in range(len(self._terms)) if self._terms.holds(t, group, lasting)]

    def _lasting(self, place: int) -> int:
        group, state, _ = self._network.places[place]
        return self._network.groups[group].automaton.look(state).holding

    def _show(self, sign: int, number: int) -> list[tuple[bool, ...]]:
        counts, mine = self._counts[number]
        group, before, moments = self._every_sign[sign]
        terms = range(len(self._terms))
        others = [counts[t] - self._terms.holds(t, group, before) for t in terms]
        shown = []
        for holding in moments:
            now = [self._terms.holds(t, group, holding) for t in terms]
            total = [others[t] + now[t] for t in terms]
            me = now if group == self._me else mine
            shown.append(tuple(bool(each(total, me)) for each in self._claims))
        return shown
