"""Automaton that watches a property, as plain data."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl import ir
from swarmdsl.base.records import replace
from swarmdsl.codegen.shared.property_texts import parts_text, sentence_text
from swarmdsl.execution.verify.composition.plain_data import SETTLED, VIOLATED, Rule, Watch
from swarmdsl.execution.verify.properties.clock_table import Table
from swarmdsl.execution.verify.properties.observer import Observer
from swarmdsl.execution.verify.swarm.groups import Group
from swarmdsl.execution.verify.swarm.subjects import place_of
from swarmdsl.ir import Count, Fact
from swarmdsl.ir.sentences import claim

_When = tuple[tuple[int, bool], ...]


def is_owed(table: Table) -> bool:
    """Return True if a property can be violated by nothing that happens any more."""
    return any(table.fails_at_end(n) and not table.is_bad(n) for n in range(table.size))


def holding(observer: Observer, group: int, bits: int) -> frozenset[int]:
    """Return the terms that hold for a robot of a group with some facts."""
    terms = observer.terms
    return frozenset(t for t in range(len(terms)) if terms.holds(t, group, bits))


def watch_of(
    observer: Observer, property_: ir.Property, robot: str | None, groups: Sequence[Group]
) -> Watch:
    """Return the automaton of an observer."""
    scope = property_.scope.claims if property_.scope is not None else ()
    claims = (*property_.claims, *scope)
    start = observer.network.start()
    numbers = _Numbers(observer.table)
    first = numbers.of(observer.start(start) - start)
    rules = []
    for source, state in numbers.every():
        for when, following in _branches(observer.table, state, (), len(claims)):
            target = numbers.of(following)
            if target != source:
                rules.append(Rule(source, when, target))
    return Watch(
        property_.name,
        sentence_text(property_),
        robot,
        place_of(robot, groups),
        tuple(map(_fact_text, observer.terms.facts)),
        tuple((parts_text(claim(each)), observer.terms.reading(each)) for each in claims),
        first,
        numbers.size,
        tuple(rules),
        observer.forgets,
    )


class _Numbers:
    """Numbers of the states of a table that are reached, in the order in which they are."""

    def __init__(self, table: Table) -> None:
        self._table = table
        self._states: list[int] = []

    @property
    def size(self) -> int:
        """Number of states that were reached."""
        return len(self._states)

    def of(self, state: int) -> int:
        """Return the number of a state."""
        if self._table.is_bad(state):
            return VIOLATED
        if self._table.is_settled(state):
            return SETTLED
        if state not in self._states:
            self._states.append(state)
        return self._states.index(state)

    def every(self) -> Iterator[tuple[int, int]]:
        """Yield all states with their numbers, also those that are reached meanwhile."""
        number = 0
        while number < len(self._states):
            yield number, self._states[number]
            number += 1


def _branches(
    table: Table, state: int, truths: tuple[bool, ...], claims: int
) -> list[tuple[_When, int]]:
    """Return the steps of a state, each with the claims that it depends on."""
    number = len(truths)
    if number == claims:
        return [((), table.step(state, truths))]
    yes, no = (_branches(table, state, (*truths, each), claims) for each in (True, False))
    if yes == no:
        return yes
    return [
        (((number, truth), *when), target)
        for truth, branches in ((True, yes), (False, no))
        for when, target in branches
    ]


def _fact_text(fact: Fact | Count) -> str:
    if isinstance(fact, Count):
        return f"{fact.role} in {fact.state}"
    role = f"{fact.robots.role} " if fact.robots is not None else ""
    return role + parts_text(claim(replace(fact, robots=None)))
