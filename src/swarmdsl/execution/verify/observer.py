"""Observer of a property in a swarm of counters: its monitor, and the truth of its claims."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import product
from typing import NamedTuple

from swarmdsl import ir
from swarmdsl.execution.monitor import OPEN, Monitor, Sentence
from swarmdsl.execution.verify.automaton import Move
from swarmdsl.execution.verify.network import Network, Step
from swarmdsl.ir import Claim, Count, Fact, Junction
from swarmdsl.ir.operations import OPERATIONS

MOST_CLAIMS = 10
"""Number of claims up to which all combinations of their truth are looked at."""

Truth = Callable[[Sequence[int], Sequence[int]], bool]
"""Truth of a claim, given for each fact how many robots it holds for, and if it does for me."""


class MonitorTable:
    """The automaton of a monitor, as a table: states are numbers, 0 is before the first step."""

    def __init__(self, sentence: Sentence, claims: int, scope: int) -> None:
        self._claims, self._scope = claims, scope
        self._monitors = [Monitor(sentence)]
        self._numbers = {self._monitors[0].memory: 0}
        self._steps: dict[tuple[int, tuple[bool, ...]], int] = {}
        self._settled: set[int] = set()
        self._look_ahead()

    def step(self, state: int, truths: tuple[bool, ...]) -> int:
        """Return the state after a step."""
        found = self._steps.get((state, truths))
        if found is None:
            monitor = self._monitors[state].copy()
            monitor.step(0, truths[: self._claims], truths[self._claims :])
            memory = monitor.memory
            found = self._numbers.setdefault(memory, len(self._monitors))
            if found == len(self._monitors):
                self._monitors.append(monitor)
            self._steps[state, truths] = found
        return found

    def is_bad(self, state: int) -> bool:
        """Return True if the property is violated."""
        return self._monitors[state].violated is not None

    def is_settled(self, state: int) -> bool:
        """Return True if it cannot be violated any more."""
        return state in self._settled

    def fails_at_end(self, state: int) -> bool:
        """Return True if the property is violated when nothing happens any more."""
        monitor = self._monitors[state].copy()
        monitor.finish(0, ended=True)
        return monitor.violated is not None

    @property
    def size(self) -> int:
        """Number of states known."""
        return len(self._monitors)

    def _look_ahead(self) -> None:
        every = list(product((False, True), repeat=self._claims + self._scope))
        number = 0
        while number < len(self._monitors):
            for truths in every:
                self.step(number, truths)
            number += 1
        dangerous = {
            state
            for state in range(number)
            if self.is_bad(state) or self._monitors[state].state == OPEN
        }
        grown = True
        while grown:
            more = {s for (s, _), target in self._steps.items() if target in dangerous}
            grown = not more <= dangerous
            dangerous |= more
        self._settled = set(range(number)) - dangerous


class Observer:
    """Follow a property in a network; `me` is the group of the robot of `each`."""

    def __init__(
        self, property_: ir.Property, table: MonitorTable, network: Network, me: int | None
    ) -> None:
        self.table = table
        self._network = network
        self._me = me
        self._mine = (1 << network.base) - 1
        self.terms = Terms(property_, network)
        scope = property_.scope.claims if property_.scope is not None else ()
        self._claims = [self.terms.truth(each) for each in (*property_.claims, *scope)]
        self._forgets = any(map(is_act, self.terms.facts))
        """True if a fact holds for a moment: the next line, whatever it shows, ends it."""
        self._rows: dict[int, _Row] = {}

    def start(self, state: int) -> int:
        """Return the first state: all robots have started, which is one moment."""
        counts = [0] * len(self.terms)
        mine = [0] * len(self.terms)
        for number, group in enumerate(self._network.groups):
            bits = 0
            for moment in group.automaton.first.moments:
                bits |= moment.holding & _momentary(group.automaton.whole.kind.facts)
            look = group.automaton.look(group.automaton.first.target)
            bits |= look.holding
            for term in range(len(self.terms)):
                holds = self.terms.holds(term, number, bits)
                counts[term] += holds * len(group.robots)
                if number == self._me:
                    mine[term] = holds
        truths = tuple(bool(each(counts, mine)) for each in self._claims)
        return state | self.table.step(0, truths)

    def is_bad(self, state: int) -> bool:
        """Return True if the property is violated."""
        return self.table.is_bad(state & self._mine)

    def is_settled(self, state: int) -> bool:
        """Return True if the property cannot be violated any more."""
        return self.table.is_settled(state & self._mine)

    def fails_at_end(self, state: int) -> bool:
        """Return True if the property is violated when nothing happens any more."""
        return self.table.fails_at_end(state & self._mine)

    def successors(self, state: int) -> Iterator[tuple[int, Step]]:
        """Yield the states after one step, each with the step."""
        network = self._network
        memory = state & self._mine
        present = network.present(state)
        seen = _Sight(self, present)
        silent = self._silence(memory, seen) - memory
        for place, _ in present:
            for step in network.row(place):
                after = network.after(state, step)
                if step.move is not None:
                    if self._is_silent(place, step.move):
                        after += silent
                    else:
                        after += self._moments(memory, place, step.move, seen) - memory
                yield after, step

    def following(self, state: int) -> Iterator[int]:
        """Yield the same states, each at least once."""
        network = self._network
        memory = state & self._mine
        present = network.present(state)
        seen = _Sight(self, present)
        silent = self._silence(memory, seen) - memory
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
            for change, move in row.loud:
                yield state + change + self._moments(memory, place, move, seen) - memory
            for change, shifts, sends, sender, moves in row.casts:
                if shifts is not known:
                    known, total = shifts, 0
                    for where, count in present:
                        shift = shifts.get(where)
                        if shift is None:
                            shift = network.shift_of(where, sends, sender)
                        total += count * shift
                after = state + change + total - shifts[place]
                for each in moves:
                    if each is None:
                        yield after + silent
                    else:
                        yield after + self._moments(memory, place, each, seen) - memory

    def is_busy(self, state: int) -> bool:
        """Return True if something happens in a state, even if it leads back to it."""
        return any(
            step.move is not None and not step.move.idle
            for place, _ in self._network.present(state)
            for step in self._network.row(place)
        )

    def _row(self, place: int) -> _Row:
        """Return the steps of a place, equal ones once; those that change a fact are loud."""
        network = self._network
        losses: dict[int, None] = {}
        plain: dict[int, None] = {}
        loud: dict[tuple[int, tuple[int, ...]], Move] = {}
        casts: dict[tuple[int, tuple[int, ...]], dict[tuple[int, ...] | None, Move | None]] = {}
        group = self._network.places[place].group
        for step in network.row(place):
            change = network.ones[step.target] - network.ones[place]
            heard = network.heard(step)
            move = step.move
            if move is None:
                losses[change] = None
                continue
            silent = self._is_silent(place, move)
            facts = None if silent else tuple(m.holding for m in move.moments)
            if heard:
                casts.setdefault((change, heard), {}).setdefault(facts, None if silent else move)
            elif facts is None:
                plain[change] = None
            else:
                loud.setdefault((change, facts), move)
        return _Row(
            list(losses),
            list(plain),
            [(change, move) for (change, _), move in loud.items()],
            [
                (change, network.shifts(sends, group), sends, group, list(moves.values()))
                for (change, sends), moves in casts.items()
            ],
        )

    def counts(self, present: Sequence[tuple[int, int]]) -> tuple[list[int], list[int]]:
        """Return for how many robots each fact holds, and if it does for me."""
        counts = [0] * len(self.terms)
        mine = [0] * len(self.terms)
        for place, count in present:
            group = self._network.places[place].group
            for term in range(len(self.terms)):
                holds = self.terms.holds(term, group, self._lasting(place))
                counts[term] += holds * count
                if group == self._me:
                    mine[term] = holds
        return counts, mine

    def _lasting(self, place: int) -> int:
        group, state, _ = self._network.places[place]
        return self._network.groups[group].automaton.look(state).holding

    def _moments(self, memory: int, place: int, move: Move, seen: _Sight) -> int:
        """Return the memory of the monitor after the moments of a move."""
        counts, mine = seen.counts
        group = self._network.places[place].group
        before = self._lasting(place)
        terms = range(len(self.terms))
        others = [counts[t] - self.terms.holds(t, group, before) for t in terms]
        for moment in move.moments:
            now = [self.terms.holds(t, group, moment.holding) for t in terms]
            total = [others[t] + now[t] for t in terms]
            me = now if group == self._me else mine
            truths = tuple(bool(each(total, me)) for each in self._claims)
            memory = self.table.step(memory, truths)
        return memory

    def _silence(self, memory: int, seen: _Sight) -> int:
        """Return the memory of the monitor after a move that changes no fact.

        It differs only after a fact that held for a moment: this is over then.
        """
        if not self._forgets:
            return memory
        return self.table.step(memory, tuple(bool(each(*seen.counts)) for each in self._claims))

    def _is_silent(self, place: int, move: Move) -> bool:
        """Return True if a move changes no fact."""
        automaton = self._network.groups[self._network.places[place].group].automaton
        lasting = self._lasting(place) & automaton.mask
        return all(each.holding & automaton.mask == lasting for each in move.moments)


class _Row(NamedTuple):
    """Steps of a place: lost messages and silent moves as differences, loud ones, and sends."""

    losses: list[int]
    plain: list[int]
    loud: list[tuple[int, Move]]
    casts: list[tuple[int, dict[int, int], tuple[int, ...], int, list[Move | None]]]


class _Sight:
    """The truth of the facts in a state, computed when it is asked for."""

    def __init__(self, observer: Observer, present: Sequence[tuple[int, int]]) -> None:
        self._observer = observer
        self._present = present

    @cached_property
    def counts(self) -> tuple[list[int], list[int]]:
        """For how many robots each fact holds, and if it does for me."""
        return self._observer.counts(self._present)


def _momentary(facts: Sequence[Fact | Count]) -> int:
    return sum(1 << n for n, each in enumerate(facts) if isinstance(each, Fact) and is_act(each))


def is_act(fact: Fact | Count) -> bool:
    """Return True for what happens, in contrast to what is."""
    return isinstance(fact, Fact) and fact.act not in ("in", "has")


class Terms:
    """Facts of a property, each with the groups that it can hold for."""

    def __init__(self, property_: ir.Property, network: Network) -> None:
        self._property = property_
        self._network = network
        self._keys: list[tuple[Fact | Count, str | None, str | None]] = []
        self._bits: list[list[int]] = []
        """For each term, the bit of its fact in each group; 0 where it cannot hold."""

    def __len__(self) -> int:
        return len(self._keys)

    @property
    def facts(self) -> list[Fact | Count]:
        """The facts, in the order of their numbers."""
        return [fact for fact, _, _ in self._keys]

    def holds(self, term: int, group: int, bits: int) -> int:
        """Return 1 if a fact holds for a robot with these facts, else 0."""
        return 1 if bits & self._bits[term][group] else 0

    def truth(self, claim: Claim) -> Truth:
        """Compile a claim."""
        if isinstance(claim, Junction):
            parts = [self.truth(each) for each in claim.claims]
            if claim.operator == "not":
                (part,) = parts
                return lambda counts, mine: not part(counts, mine)
            together = all if claim.operator == "and" else any
            return lambda counts, mine: together(part(counts, mine) for part in parts)
        if isinstance(claim, Count):
            term = self._term(claim, claim.role, None)
            compare, number = OPERATIONS[claim.comparison], claim.number
            return lambda counts, mine: bool(compare(counts[term], number))
        robots = claim.robots
        if robots is None:
            each = self._property.each
            if each is not None and claim.act != "arrives":
                term = self._term(claim, each, None)
                return lambda counts, mine: bool(mine[term])
            term = self._term(claim, None, None)
            return lambda counts, mine: counts[term] > 0
        return self._of_robots(claim, robots)

    def _of_robots(self, claim: Fact, robots: ir.Robots) -> Truth:
        if robots.quantifier == "index":
            term = self._term(claim, robots.role, f"{robots.role}[{robots.index or 0}]")
            return lambda counts, mine: counts[term] > 0
        term = self._term(claim, robots.role, None)
        if robots.quantifier == "number":
            assert robots.number is not None
            least, most = robots.number.lower, robots.number.upper
            return lambda counts, mine: (
                least <= counts[term] and (most is None or counts[term] <= most)
            )
        other = robots.other
        if robots.quantifier == "some":
            return lambda counts, mine: counts[term] - (other and mine[term]) > 0
        if robots.quantifier == "no":
            return lambda counts, mine: counts[term] - (other and mine[term]) == 0
        size = sum(len(g.robots) for g in self._network.groups if g.role == robots.role)
        mine_too = other and self._property.each == robots.role
        return lambda counts, mine: (
            counts[term] - (other and mine[term]) == size - (1 if mine_too else 0)
        )

    def _term(self, fact: Fact | Count, role: str | None, robot: str | None) -> int:
        key = (fact, role, robot)
        if key not in self._keys:
            self._keys.append(key)
            bits = []
            for group in self._network.groups:
                facts = group.automaton.whole.kind.facts
                meant = (role in (None, group.role)) and (robot is None or robot in group.robots)
                same = (n for n, each in enumerate(facts) if same_fact(each, fact))
                bits.append(1 << next(same, -1) if meant and _has(facts, fact) else 0)
            self._bits.append(bits)
        return self._keys.index(key)


def _has(facts: Sequence[Fact | Count], fact: Fact | Count) -> bool:
    return any(same_fact(each, fact) for each in facts)


def same_fact(one: Fact | Count, other: Fact | Count) -> bool:
    """Return True if two facts are about the same, of whichever robots."""
    return meaning(one) == meaning(other)


def meaning(fact: Fact | Count) -> tuple[str, str, ir.Expression | None]:
    """Return what a fact says, without the robots that it says it of."""
    if isinstance(fact, Count):
        return ("in", fact.state, None)
    return (fact.act, fact.name, fact.guard)
