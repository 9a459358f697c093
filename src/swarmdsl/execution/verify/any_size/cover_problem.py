"""Questions for a search backwards: robots with their steps, and sets of them to look for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from typing import NamedTuple

from swarmdsl import ir
from swarmdsl.execution.verify.any_size.coverability import Population, Rule, Token, Tokens
from swarmdsl.execution.verify.any_size.upward_closed import Need, NotCoveredError, Wanted
from swarmdsl.execution.verify.automata.labels import Move
from swarmdsl.execution.verify.proofs.single_robot import Alone
from swarmdsl.execution.verify.swarm.groups import Group
from swarmdsl.execution.verify.swarm.model import Model
from swarmdsl.execution.verify.swarm.network import Network
from swarmdsl.execution.verify.swarm.propositions import at_start, is_of_one
from swarmdsl.execution.verify.swarm.subjects import place_of

Bounds = Mapping[str, tuple[int, int | None]]
"""Roles with any number of robots: the least and the greatest number, None if there is none."""


class Question(NamedTuple):
    """Robots, sets of them to look for, and numbers of robots that violate at once."""

    swarm: list[Population]
    wanted: set[Tokens]
    at_start: tuple[int, ...] | None = None


def question(
    property_: ir.Property, model: Model, bounds: Bounds, groups: Sequence[Group], me: str | None
) -> Question | None:
    """Return what to look for; None if the property holds from the start on."""
    network = Network(groups, model.alphabet, 1, lossy=True, faults=model.environment.faults)
    mine = place_of(me, groups)
    swarm = [_population(number, groups, bounds) for number in range(len(groups))]
    try:
        return _Direct(property_, network, swarm, mine).question()
    except NotCoveredError:
        # With more memory of the one robot that it is about, it may be covered.
        if mine is None or not is_of_one(property_):
            raise
        return _of_one(property_, network, swarm, mine)


def _population(number: int, groups: Sequence[Group], bounds: Bounds) -> Population:
    group = groups[number]
    automaton = group.automaton
    least: int = len(group.robots)
    most: int | None = least
    if group.role in bounds and least > 1:
        others = sum(g.role == group.role and g is not group for g in groups)
        least, most = bounds[group.role]
        least = max(least - others, 0)
        most = max(most - others, 0) if most is not None else None
    messages = range(len(automaton.whole.alphabet.messages))
    return Population(
        least,
        most,
        automaton.first.target,
        automaton.first.sends,
        heard=[frozenset(m for m in messages if group.hears(m, source)) for source in groups],
    )


def _moves(
    network: Network, swarm: Sequence[Population], group: int
) -> Iterator[tuple[int, int | None, Move]]:
    """Yield the moves of a robot of a group, each with its state and the message it hears."""
    automaton = network.groups[group].automaton
    messages = sorted(frozenset[int]().union(*swarm[group].heard))
    for state in range(automaton.count):
        # Any number of robots may be lost: that is more than there are.
        loss = automaton.loss(state)
        if loss is not None:
            yield state, None, loss
        if automaton.ended(state):
            continue
        for move in automaton.moves(state) or ():
            yield state, None, move
        for message in messages:
            for heard in automaton.moves_on(state, message):
                yield state, message, heard


class _Direct:
    """A claim that must not come true, as long as another one has not."""

    def __init__(
        self,
        property_: ir.Property,
        network: Network,
        swarm: list[Population],
        me: int | None,
    ) -> None:
        if property_.scope is not None:
            raise NotCoveredError("it is about a part of each run")
        self._network = network
        self._swarm = swarm
        first, *others = property_.claims
        match property_.kind:
            case "never" | "only":
                self._bad = Wanted(property_, first, network, swarm, me)
            case "always":
                self._bad = Wanted(property_, first, network, swarm, me, holds=False)
            case _:
                raise NotCoveredError("it counts what happens")
        self._before: Wanted | None = None
        self._ends: list[Need] = []
        """Needs of single robots that end the part of a run in which the claim is bad."""
        if property_.kind == "only":
            self._before = Wanted(property_, others[0], network, swarm, me)
            for needs in self._before.alternatives:
                if len(needs) != 1 or needs[0].least != 1:
                    raise NotCoveredError("what comes before it takes more than one robot")
                self._ends += needs

    def question(self) -> Question | None:
        """Return what to look for; None if it is allowed from the start on."""
        groups = self._network.groups
        for number, population in enumerate(self._swarm):
            if self._is_end(number, at_start(groups[number].automaton)):
                if population.least:
                    return None
                population.most = 0
        places = []
        for number, group in enumerate(groups):
            self._swarm[number].rules = list(self._rules(number))
            for state in range(group.automaton.count):
                bits = group.automaton.look(state).holding
                if not self._is_end(number, bits):
                    places.append((number, state, bits))
        wanted: set[Tokens] = set()
        for needs in self._bad.alternatives:
            wanted |= self._bad.sets(needs, places)
            for number in range(len(groups)):
                wanted |= self._moments(number, needs, places)
        return Question(self._swarm, wanted, self._start())

    def _rules(self, group: int) -> Iterator[Rule]:
        for state, message, move in _moves(self._network, self._swarm, group):
            if not any(self._is_end(group, each.holding) for each in move.moments):
                yield Rule(state, move.target, message, move.sends)

    def _moments(
        self, group: int, needs: Sequence[Need], places: Sequence[tuple[int, int, int]]
    ) -> set[Tokens]:
        """Return the robots before a move of one of a group in which the claim comes true."""
        automaton = self._network.groups[group].automaton
        found: set[Tokens] = set()
        known: set[tuple[Token, tuple[bool, ...]]] = set()
        for state, message, move in _moves(self._network, self._swarm, group):
            before = self._bad.met(needs, group, automaton.look(state).holding)
            after = self._bad.met(needs, group, automaton.look(move.target).holding)
            token = Token(group, state, () if message is None else (message,))
            for moment in move.moments:
                if self._is_end(group, moment.holding):
                    break
                met = self._bad.met(needs, group, moment.holding)
                if (token, met) in known or _is_less(met, before) or _is_less(met, after):
                    # Then the claim is also true before the move or after it.
                    continue
                known.add((token, met))
                found |= self._bad.sets(needs, places, (token, met))
        return found

    def _is_end(self, group: int, bits: int) -> bool:
        return self._before is not None and any(self._before.met(self._ends, group, bits))

    def _start(self) -> tuple[int, ...] | None:
        """Return the smallest swarm that violates the property when it starts, or None."""
        more = max((n.least for needs in self._bad.alternatives for n in needs), default=0)
        every = []
        for population in self._swarm:
            most = population.most if population.most is not None else population.least + more
            every.append(range(population.least, min(most, population.least + more) + 1))
        bits = [at_start(group.automaton) for group in self._network.groups]
        for numbers in sorted(product(*every), key=sum):
            present = [(n, bits[n], number) for n, number in enumerate(numbers)]
            if self._bad.holds(present):
                return numbers
        return None


def _is_less(one: Sequence[bool], other: Sequence[bool]) -> bool:
    return all(not is_met or also for is_met, also in zip(one, other, strict=True))


def _of_one(property_: ir.Property, network: Network, swarm: list[Population], me: int) -> Question:
    """Return what to look for: the states of one robot with those of the monitor.

    What other robots do ends what held for a moment. Here this may happen at any time.
    """
    alone = Alone(property_, network.groups[me].automaton)
    table = alone.table
    moves: dict[int, list[tuple[int | None, Move]]] = {}
    for state, message, move in _moves(network, swarm, me):
        moves.setdefault(state, []).append((message, move))
    first = alone.start()
    numbers = {first: 0}
    todo = [first]
    rules: list[Rule] = []
    wanted: set[Tokens] = set()
    while todo:
        place = todo.pop()
        state, memory = place
        if table.is_bad(memory):
            wanted.add((Token(me, numbers[place]),))
            continue
        if table.fails_at_end(memory):
            raise NotCoveredError("it is about how runs end")
        if table.is_settled(memory):
            continue
        following: list[tuple[int, int, int | None, tuple[int, ...]]] = []
        for now in alone.elsewhere(state, memory):
            following.append((state, now, None, ()))
        for message, move in moves.get(state, ()):
            following.append((move.target, alone.after(memory, move), message, move.sends))
        for target, now, message, sends in following:
            after = (target, now)
            if after not in numbers:
                numbers[after] = len(numbers)
                todo.append(after)
            rules.append(Rule(numbers[place], numbers[after], message, sends))
    for number, population in enumerate(swarm):
        population.rules = [
            Rule(state, move.target, message, move.sends)
            for state, message, move in _moves(network, swarm, number)
        ]
    swarm[me].first = 0
    swarm[me].rules = rules
    return Question(swarm, wanted)
