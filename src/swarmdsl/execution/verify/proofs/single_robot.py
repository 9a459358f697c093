"""Proofs about one robot, whatever the others do."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl import ir
from swarmdsl.execution.verify.automata.labels import Move
from swarmdsl.execution.verify.automata.limits import Budget
from swarmdsl.execution.verify.proofs.overapproximation import robot_alone
from swarmdsl.execution.verify.proofs.verdict import Verdict
from swarmdsl.execution.verify.properties.sentence import table_of
from swarmdsl.execution.verify.swarm.groups import Group, Local
from swarmdsl.execution.verify.swarm.model import Model
from swarmdsl.execution.verify.swarm.network import Network
from swarmdsl.execution.verify.swarm.propositions import Terms, arriving, at_start, is_of_one

_COVERED = ("never", "always", "only", "times", "leads")
"""Patterns that a finite run violates, and what may be answered at once."""


def is_alone(property_: ir.Property) -> bool:
    """Return True if a property is about one robot, and about what arrives from outside."""
    return property_.kind in _COVERED and is_of_one(property_)


def without_others(
    property_: ir.Property, model: Model, me: str | None, budget: Budget
) -> Verdict | None:
    """Prove a property of one robot of which not all is known, whatever the others send.

    Return None if it may be violated so. The robot is looked at for all such properties at once; if
    it has too many states, with open variables, then for this property alone.
    """
    like = [each for each in model.properties if each.each == property_.each and is_alone(each)]
    one = [property_]
    for properties, is_open in ((like, False), (like, True), (one, True), (one, False)):
        alone = robot_alone(model, properties, me, budget, is_open=is_open)
        if alone is None or property_ not in alone.properties or not alone.complete:
            continue
        (own,) = alone.groups([property_], me=me)
        if not alone.doubts([own]):
            states = hearing_all(property_, own.automaton)
            if states is not None:
                return Verdict(property_, "holds", states, robot=me, alone=True, open=alone.open)
        if not is_open:
            # With open variables even more would be possible. Data that are not covered are left
            # open afterwards, for the whole swarm.
            return None
    return None


def hearing_all(property_: ir.Property, automaton: Local) -> int | None:
    """Prove a property of one robot that hears all messages at any time.

    What must happen must do so in the same step: then no time passes before it, and nothing else
    need happen. Return the number of states that were looked at, or None if it may be violated so.
    """
    alone = Alone(property_, automaton)
    table = alone.table
    seen = {alone.start()}
    todo = list(seen)
    while todo:
        state, memory = todo.pop()
        if table.is_bad(memory) or table.fails_at_end(memory):
            return None
        if not table.is_settled(memory):
            found = alone.following(state, memory)
            todo += found - seen
            seen |= found
    return len(seen)


def distances(property_: ir.Property, automaton: Local) -> dict[tuple[int, int], int]:
    """Return the number of steps to a violation by a robot that hears all messages.

    The keys are its states, each with the memory of the monitor. Those from which it cannot violate
    the property are left out.
    """
    alone = Alone(property_, automaton)
    before: dict[tuple[int, int], list[tuple[int, int]]] = {alone.start(): []}
    todo = list(before)
    for each in todo:
        if not alone.table.is_bad(each[1]) and not alone.table.is_settled(each[1]):
            for following in alone.following(*each):
                if following not in before:
                    before[following] = []
                    todo.append(following)
                before[following].append(each)
    found = {each: 0 for each in before if alone.table.is_bad(each[1])}
    todo = list(found)
    for each in todo:
        for earlier in before[each]:
            if earlier not in found:
                found[earlier] = found[each] + 1
                todo.append(earlier)
    return found


class Alone:
    """Steps of one robot that hears all messages at any time, with the monitor of a property."""

    def __init__(self, property_: ir.Property, automaton: Local) -> None:
        network = Network([Group(automaton, ("",))], automaton.whole.alphabet, 0, lossy=False)
        self.table = table_of(property_)
        self._automaton = automaton
        self._terms = Terms(property_, network)
        scope = property_.scope.claims if property_.scope is not None else ()
        self._claims = [self._terms.truth(each) for each in (*property_.claims, *scope)]
        self._outside = list(arriving(self._terms.facts))

    def start(self) -> tuple[int, int]:
        """Return the first state, with the memory of the monitor."""
        return self._automaton.first.target, self._step(0, at_start(self._automaton))

    def following(self, state: int, memory: int) -> set[tuple[int, int]]:
        """Return the states after a step, each with the memory of the monitor."""
        found = {(state, after) for after in self.elsewhere(state, memory)}
        for message in (None, *range(len(self._automaton.whole.alphabet.messages))):
            steps = self.steps(state, memory, message)
            found |= {(move.target, after) for move, after in steps}
        return found

    def elsewhere(self, state: int, memory: int) -> set[int]:
        """Return the memories after a line of another robot, with what arrives there."""
        holding = self._automaton.look(state).holding
        return {self._step(memory, holding, others) for others in self._outside}

    def steps(self, state: int, memory: int, message: int | None) -> Iterator[tuple[Move, int]]:
        """Yield moves on a message, or without one, each with the memory after it."""
        automaton = self._automaton
        if message is not None:
            moves = list(automaton.moves_on(state, message))
        else:
            loss = automaton.loss(state)
            moves = [*(automaton.moves(state) or ()), *([loss] if loss is not None else ())]
        for move in moves:
            yield move, self.after(memory, move)

    def is_bad(self, memory: int) -> bool:
        """Return True if the property is violated."""
        return self.table.is_bad(memory)

    def _step(self, memory: int, bits: int, others: frozenset[int] = frozenset()) -> int:
        terms = self._terms
        holding = [terms.holds(t, 0, bits) or int(t in others) for t in range(len(terms))]
        return self.table.step(memory, tuple(bool(each(holding, holding)) for each in self._claims))

    def after(self, memory: int, move: Move) -> int:
        """Return the memory of the monitor after a move."""
        for moment in move.moments:
            memory = self._step(memory, moment.holding)
        return memory
