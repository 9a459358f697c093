"""Proofs about one robot, whatever the others do."""

from __future__ import annotations

from swarmdsl import ir
from swarmdsl.execution.verify.automata.labels import Move
from swarmdsl.execution.verify.automata.limits import Budget
from swarmdsl.execution.verify.proofs.overapproximation import robot_alone
from swarmdsl.execution.verify.proofs.verdict import Verdict
from swarmdsl.execution.verify.properties.sentence import table_of
from swarmdsl.execution.verify.swarm.groups import Group, Local
from swarmdsl.execution.verify.swarm.model import Model
from swarmdsl.execution.verify.swarm.network import Network
from swarmdsl.execution.verify.swarm.propositions import Terms, arriving, facts_of

_COVERED = ("never", "always", "only", "times", "leads")
"""Patterns that a finite run violates, and what may be answered at once."""


def is_alone(property_: ir.Property) -> bool:
    """Return True if a property is about one robot, and about what arrives from outside."""
    if property_.kind not in _COVERED:
        return False
    return all(isinstance(f, ir.Fact) and f.robots is None for f in facts_of(property_))


def without_others(
    property_: ir.Property, model: Model, me: str | None, budget: Budget
) -> Verdict | None:
    """Prove a property of one robot of which not all is known, whatever the others send.

    Return None if it may be violated so. First the robot is looked at for all such properties at
    once. If it has too many states, so it is with open variables, and in the end for one property.
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
            # Without its data more would be possible. Those that are not covered are left open for
            # the whole swarm.
            return None
    return None


def hearing_all(property_: ir.Property, automaton: Local) -> int | None:
    """Prove a property of one robot that hears all messages at any time.

    What must happen must do so in the same step: then no time passes before it, and nothing else
    need happen.
    Return the number of states that were looked at, or None if it may be violated so.
    """
    group = Group(automaton, ("",))
    table = table_of(property_)
    terms = Terms(property_, Network([group], automaton.whole.alphabet, 0, lossy=False))
    scope = property_.scope.claims if property_.scope is not None else ()
    claims = [terms.truth(each) for each in (*property_.claims, *scope)]
    outside = list(arriving(terms.facts))

    def step(memory: int, bits: int, others: frozenset[int] = frozenset()) -> int:
        holding = [terms.holds(t, 0, bits) or int(t in others) for t in range(len(terms))]
        return table.step(memory, tuple(bool(each(holding, holding)) for each in claims))

    def after(memory: int, move: Move) -> int:
        for moment in move.moments:
            memory = step(memory, moment.holding)
        return memory

    first = automaton.first
    bits = 0
    for moment in first.moments:
        bits |= moment.holding
    seen = {(first.target, step(0, bits))}
    todo = list(seen)
    while todo:
        state, memory = todo.pop()
        if table.is_bad(memory) or table.fails_at_end(memory):
            return None
        if table.is_settled(memory):
            continue
        # A line of another robot, on which an event may arrive from outside.
        holding = automaton.look(state).holding
        found = {(state, step(memory, holding, others)) for others in outside}
        moves = list(automaton.moves(state) or ())
        loss = automaton.loss(state)
        if loss is not None:
            moves.append(loss)
        for message in range(len(automaton.whole.alphabet.messages)):
            moves += automaton.moves_on(state, message)
        found |= {(move.target, after(memory, move)) for move in moves}
        todo += found - seen
        seen |= found
    return len(seen)
