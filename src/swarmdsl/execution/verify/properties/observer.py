"""Observer of a property in a swarm of counters: its monitor, and the truth of its claims."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from swarmdsl import ir
from swarmdsl.execution.verify.automata.labels import Move
from swarmdsl.execution.verify.properties.clock_table import Table
from swarmdsl.execution.verify.properties.truths import Sight, Truths
from swarmdsl.execution.verify.swarm.groups import Local, Step
from swarmdsl.execution.verify.swarm.network import Network
from swarmdsl.execution.verify.swarm.propositions import Terms, at_start, is_act


class Observer:
    """Follow a property in a network; `me` is the group of the robot of `each`.

    With `others`, robots that are not in the network may act at any time, which ends what held
    for a moment.
    """

    def __init__(
        self,
        property_: ir.Property,
        table: Table,
        network: Network,
        me: int | None,
        *,
        others: bool = False,
    ) -> None:
        self.property = property_
        self.table = table
        self.network = network
        self._me = me
        self.mine = (1 << network.base) - 1
        self.terms = Terms(property_, network)
        scope = property_.scope.claims if property_.scope is not None else ()
        self._claims = [self.terms.truth(each) for each in (*property_.claims, *scope)]
        self.forgets = any(map(is_act, self.terms.facts))
        """True if a fact holds for a moment: the next line, whatever it shows, ends it."""
        self.others = others and self.forgets
        self._open: dict[int, bool] = {}
        self._rows: dict[int, _Row] = {}
        self._truths = Truths(network, self.terms, self._claims, me)
        self._singles: dict[int, list[tuple[Step, int, tuple[int, ...], bool]]] = {}

    def start(self, state: int) -> int:
        """Return the first state: all robots have started, which is one moment."""
        counts = [0] * len(self.terms)
        mine = [0] * len(self.terms)
        for number, group in enumerate(self.network.groups):
            bits = at_start(group.automaton)
            for term in range(len(self.terms)):
                holds = self.terms.holds(term, number, bits)
                counts[term] += holds * len(group.robots)
                if number == self._me:
                    mine[term] = holds
        truths = tuple(bool(each(counts, mine)) for each in self._claims)
        return state | self.table.step(0, truths)

    def is_bad(self, state: int) -> bool:
        """Return True if the property is violated."""
        return self.table.is_bad(state & self.mine)

    def is_settled(self, state: int) -> bool:
        """Return True if the property cannot be violated any more."""
        return self.table.is_settled(state & self.mine)

    def fails_at_end(self, state: int) -> bool:
        """Return True if the property is violated when nothing happens any more."""
        return self.table.fails_at_end(state & self.mine)

    def is_open(self, memory: int) -> bool:
        """Return True if the property is violated unless something happens."""
        found = self._open.get(memory)
        if found is None:
            found = not self.table.is_bad(memory) and self.table.fails_at_end(memory)
            self._open[memory] = found
        return found

    def successors(self, state: int) -> Iterator[tuple[int, Step]]:
        """Yield the states after one step, each with the step."""
        for after, step, _ in self.passing(state):
            yield after, step

    def passing(self, state: int) -> Iterator[tuple[int, Step, Sequence[int]]]:
        """Yield the states after one step, each with the memories of the monitor at its moments."""
        network = self.network
        memory = state & self.mine
        present = network.present(state)
        seen = Sight(present)
        silent = [self._silence(memory, seen)]
        for place, _ in present:
            group = network.places[place].group
            for step, change, heard, is_silent in self._single_steps(place):
                if network.is_waiting(step, present):
                    continue
                after = state + change
                if heard:
                    shift = network.shift_of(place, heard, group)
                    after += network.cast(state, heard, group) - shift
                passed = [memory]
                if is_silent:
                    passed = silent
                elif step.move is not None:
                    passed = self._memories(memory, place, step.move, seen) or passed
                yield after + passed[-1] - memory, step, passed
        yield from self._risks(state, present)

    def risking(self, state: int) -> Iterator[int]:
        """Yield the states after a loss of a robot, or of what a lost one has sent."""
        if not self.network.faults:
            return
        for after, _, _ in self._risks(state, self.network.present(state)):
            yield after

    def _risks(
        self, state: int, present: Sequence[tuple[int, int]]
    ) -> Iterator[tuple[int, Step, Sequence[int]]]:
        memory = state & self.mine
        seen = Sight(present)
        for step in self.network.risks(present):
            if self.network.is_waiting(step, present):
                continue
            passed = [memory]
            if step.move is not None:
                # The loss of a robot whose machines have ended has no line.
                passed = self._memories(memory, step.place, step.move, seen) or passed
            yield self.network.after(state, step) + passed[-1] - memory, step, passed

    def _single_steps(self, place: int) -> list[tuple[Step, int, tuple[int, ...], bool]]:
        """Return the steps of a place: differences, messages, and True for silent moves."""
        found = self._singles.get(place)
        if found is None:
            ones = self.network.ones
            found = self._singles[place] = [
                (
                    step,
                    ones[step.target] - ones[place],
                    self.network.heard(step),
                    step.move is not None and self._is_silent(place, step.move),
                )
                for step in self.network.row(place)
            ]
        return found

    def following(self, state: int) -> Iterator[int]:
        """Yield the states after one step, each at least once."""
        network = self.network
        if network.eager:
            yield from (after for after, _, _ in self.passing(state))
            return
        memory = state & self.mine
        present = network.present(state)
        seen = Sight(present)
        silent = self._silence(memory, seen) - memory
        if self.others and silent:
            yield state + silent
        known: Mapping[int, int] | None = None
        total = 0
        for place, _ in present:
            row = self._rows.get(place)
            if row is None:
                row = self._rows[place] = self._row(place)
            for change in row.losses:
                yield state + change
            for change in row.plain:
                yield state + change + silent
            for change, sign in row.loud:
                yield state + change + self._moments(memory, sign, seen) - memory
            for change, shifts, sends, sender, signs in row.casts:
                if shifts is not known:
                    known, total = shifts, 0
                    for where, count in present:
                        shift = shifts.get(where)
                        if shift is None:
                            shift = network.shift_of(where, sends, sender)
                        total += count * shift
                after = state + change + total - shifts[place]
                for each in signs:
                    if each is None:
                        yield after + silent
                    else:
                        yield after + self._moments(memory, each, seen) - memory

    def is_busy(self, state: int) -> bool:
        """Return True if something happens in a state, even if it leads back to it."""
        return any(
            step.move is not None and not step.move.idle
            for place, _ in self.network.present(state)
            for step in self.network.row(place)
        )

    def _row(self, place: int) -> _Row:
        """Return the steps of a place, equal ones once; those that change a fact are loud."""
        network = self.network
        losses: dict[int, None] = {}
        plain: dict[int, None] = {}
        loud: dict[tuple[int, int], None] = {}
        casts: dict[tuple[int, tuple[int, ...]], dict[int | None, None]] = {}
        group = self.network.places[place].group
        for step in network.row(place):
            change = network.ones[step.target] - network.ones[place]
            heard = network.heard(step)
            move = step.move
            if move is None:
                losses[change] = None
                continue
            sign = None if self._is_silent(place, move) else self._truths.sign(place, move)
            if heard:
                casts.setdefault((change, heard), {})[sign] = None
            elif sign is None:
                plain[change] = None
            else:
                loud[change, sign] = None
        return _Row(
            list(losses),
            list(plain),
            list(loud),
            [
                (change, network.shifts(sends, group), sends, group, list(signs))
                for (change, sends), signs in casts.items()
            ],
        )

    def _moments(self, memory: int, sign: int, seen: Sight) -> int:
        """Return the memory of the monitor after the moments of a move."""
        for truths in self._truths.after(sign, seen):
            memory = self.table.step(memory, truths)
        return memory

    def _memories(self, memory: int, place: int, move: Move, seen: Sight) -> list[int]:
        """Return the memories of the monitor at the moments of a move."""
        passed = []
        for truths in self._truths.after(self._truths.sign(place, move), seen):
            memory = self.table.step(memory, truths)
            passed.append(memory)
        return passed

    def _silence(self, memory: int, seen: Sight) -> int:
        """Return the memory of the monitor after a move that changes no fact.

        It differs only after a fact that held for a moment: this is over then.
        """
        if not self.forgets:
            return memory
        return self.table.step(memory, self._truths.now(seen))

    def _is_silent(self, place: int, move: Move) -> bool:
        group, state, _ = self.network.places[place]
        return is_silent(self.network.groups[group].automaton, state, move)


class _Row(NamedTuple):
    """Steps of a place: lost messages and silent moves as differences, loud ones, and sends.

    Loud ones have the number of what they show.
    """

    losses: list[int]
    plain: list[int]
    loud: list[tuple[int, int]]
    casts: list[tuple[int, dict[int, int], tuple[int, ...], int, list[int | None]]]


def is_silent(automaton: Local, state: int, move: Move) -> bool:
    """Return True if a move of a state changes no fact."""
    lasting = automaton.look(state).holding & automaton.mask
    return all(each.holding & automaton.mask == lasting for each in move.moments)
