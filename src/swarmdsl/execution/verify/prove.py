"""Proofs of properties: a search for a run that violates one, in the product with its monitor."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice

from swarmdsl import ir
from swarmdsl.base.records import replace
from swarmdsl.execution.verify.explore import Graph, observe
from swarmdsl.execution.verify.flaws import OPEN
from swarmdsl.execution.verify.groups import Group, Local
from swarmdsl.execution.verify.influence import cone
from swarmdsl.execution.verify.laps import endless
from swarmdsl.execution.verify.lassos import Lassos
from swarmdsl.execution.verify.late_runs import late
from swarmdsl.execution.verify.limits import Budget
from swarmdsl.execution.verify.model import Model
from swarmdsl.execution.verify.moves import Move
from swarmdsl.execution.verify.network import Network
from swarmdsl.execution.verify.observer import Observer
from swarmdsl.execution.verify.play import play
from swarmdsl.execution.verify.possible import prove_possible
from swarmdsl.execution.verify.run import Run, steps_between
from swarmdsl.execution.verify.sentence import (
    is_about_ends,
    length_of,
    not_shown,
    table_of,
)
from swarmdsl.execution.verify.subjects import about, place_of
from swarmdsl.execution.verify.terms import Terms, arriving, facts_of
from swarmdsl.execution.verify.timed import prove_exactly
from swarmdsl.execution.verify.timed_observer import LateObserver
from swarmdsl.execution.verify.verdict import (
    ESTIMATE,
    Outcome,
    Verdict,
    not_run,
    unfinished,
    violated,
)

_SAFE = ("never", "always", "only", "times")
"""Patterns that a finite run violates."""
_MOST_LASSOS = 60
"""Number of loops that are tried on the engine."""


def prove(property_: ir.Property, model: Model, budget: Budget) -> Verdict:
    """Look for a run that violates a property."""
    if property_.chance is not None and property_.chance.bound == "most":
        return Verdict(
            property_, "unknown", reason=f"a greatest probability is not covered: {ESTIMATE}"
        )
    reason = not_shown(property_)
    if reason:
        return Verdict(property_, "unknown", reason=reason)
    if property_.each is None:
        return _one(property_, model, None, budget)
    found = [_one(property_, model, robot, budget) for robot in model.one_of_each(property_)]
    rank: dict[Outcome, int] = {"fails": 0, "unknown": 1, "up to": 2, "holds": 3}
    worst = min(found, key=lambda each: rank[each.outcome], default=None)
    if worst is None:
        return Verdict(property_, "holds", reason=f"there is no `{property_.each}`")
    return replace(worst, full=tuple(sorted({name for each in found for name in each.full})))


def _one(property_: ir.Property, model: Model, me: str | None, budget: Budget) -> Verdict:
    """Decide on a property, of one robot if it is about each."""
    verdict = _without_clocks(property_, model, me, budget)
    if verdict.reason in map(not_run, OPEN) and property_.kind != "possible":
        # A longer run, in which robots are far from each other and hear of all, may violate it.
        again = _without_clocks(property_, model, me, budget, lonely=True)
        verdict = again if again.outcome == "fails" else verdict
    if verdict.outcome != "unknown" or verdict.place is not None:
        return verdict
    if model.options.exact and not model.environment.faults:
        return prove_exactly(property_, model, me, budget, verdict)
    way_out = ""
    if model.options.exact:
        way_out = "; clocks are for robots that are not lost: try `--faults 0`"
    elif property_.within is not None and model.environment.faults:
        way_out = "; without losses, try `--time exact --faults 0`"
    elif property_.within is not None:
        way_out = "; try `--time exact`"
    return replace(verdict, reason=verdict.reason + way_out)


def _without_clocks(
    property_: ir.Property, model: Model, me: str | None, budget: Budget, *, lonely: bool = False
) -> Verdict:
    """Decide on a property for functions and delays that take any time.

    With `lonely`, only runs are looked at in which nobody is near another robot, or takes one for
    lost that it could hear.
    """
    if is_about_ends(property_):
        return _in_the_end(property_, model, me, budget, lonely=lonely)
    every = model.groups([property_], me=me)
    mine = place_of(me, every)
    seen = set(about(property_, model, every))
    if mine is not None:
        seen.add(mine)
    groups = cone(model, every, seen) or every
    is_sure = model.complete and not model.doubts(groups)
    if mine is not None and is_sure and _is_alone(property_):
        states = _alone(property_, every[mine].automaton)
        if states is not None:
            return Verdict(property_, "holds", states, robot=me, alone=True)
    if mine is not None and not is_sure and _is_alone(property_):
        alone = model.alone(property_, me, budget)
        (own,) = alone.groups([property_], me=me)
        if alone.complete and not alone.doubts([own]):
            states = _alone(property_, own.automaton)
            if states is not None:
                return Verdict(property_, "holds", states, robot=me, alone=True)
    if property_.kind == "possible":
        place = groups.index(every[mine]) if mine is not None else None
        return prove_possible(property_, model, model.network(groups, spared=me), place, me, budget)
    observer = observer_of(
        property_, model, groups, me, lonely=lonely, others=len(groups) < len(every)
    )
    graph = observe(observer.network, observer, budget)
    if graph.bad is not None and observer.others:
        # Whether others act at that moment is known only with all of them.
        groups = every
        observer = observer_of(property_, model, groups, me, lonely=lonely, others=False)
        graph = observe(observer.network, observer, budget)
    if graph.bad is None:
        return _not_violated(property_, model, graph, groups, me, budget)
    found = violated(property_, _run(property_, observer, graph, graph.bad), graph, me)
    if found.run is None and property_.chance is None:
        # A longer run, in which messages arrive first, may be one that can be.
        observer = observer_of(
            property_, model, groups, me, lonely=lonely, others=observer.others, eager=True
        )
        graph = observe(observer.network, observer, budget)
        if graph.bad is not None:
            again = violated(property_, _run(property_, observer, graph, graph.bad), graph, me)
            found = again if again.run is not None else found
    return found


def _in_the_end(
    property_: ir.Property, model: Model, me: str | None, budget: Budget, *, lonely: bool
) -> Verdict:
    """Decide on a property that runs that go on for ever can violate.

    If robots of a group must be told apart to decide, each is looked at by itself.
    """
    flaw = ""
    for single in (False, True):
        every = model.groups([property_], me=me, tasks=True, single=single)
        seen = set(about(property_, model, every))
        seen |= {number for number, group in enumerate(every) if group.robots == (me,)}
        groups = cone(model, every, seen) or every
        observer = observer_of(
            property_, model, groups, me, lonely=lonely, others=len(groups) < len(every)
        )
        if observer.others:
            # What holds for a moment ends when any robot does something.
            groups = every
            observer = observer_of(property_, model, groups, me, lonely=lonely, others=False)
        graph = observe(observer.network, observer, budget)
        if graph.bad is not None:
            return violated(property_, _run(property_, observer, graph, graph.bad), graph, me)
        lassos = Lassos(graph, observer, budget)
        doubts = model.doubts(groups)
        found = 0
        for lasso in islice(lassos, _MOST_LASSOS):
            found += 1
            if lasso.loop and doubts:
                # What is not covered may end the loop.
                break
            run = endless(observer.network, lasso, property_, me)
            if not run.flaw:
                return violated(property_, run, graph, me)
            flaw = flaw or run.flaw
        graph.complete &= lassos.complete
        if doubts or not found:
            return _not_violated(property_, model, graph, groups, me, budget)
        if all(len(group.robots) == 1 for group in groups):
            break
    return Verdict(property_, "unknown", len(graph.seen), not_run(flaw), robot=me)


def _run(property_: ir.Property, observer: Observer, graph: Graph, bad: int) -> Run:
    """Return a run to a state that violates a property, at once or if nothing follows."""
    way = graph.way(bad)
    steps = steps_between(way, lambda state: list(observer.successors(state)))
    is_bad = observer.is_bad(way[-1])
    within = length_of(property_)
    if within is not None:
        return late(observer.network, steps, property_, within, ended=not is_bad)
    run = play(observer.network, steps, property_)
    return run if is_bad else replace(run, loop=0)


def observer_of(
    property_: ir.Property,
    model: Model,
    groups: Sequence[Group],
    me: str | None,
    *,
    others: bool,
    eager: bool = False,
    lonely: bool = False,
) -> Observer:
    """Return the observer of a property in some groups, of one robot if it is about each."""
    table = table_of(property_)
    is_timed = property_.within is not None
    # What must happen is asked of robots that are there.
    spared = me if is_about_ends(property_) else None
    network = model.network(
        groups,
        base=max(table.size, 2).bit_length(),
        timed=is_timed,
        spared=spared,
        eager=eager,
        lonely=lonely,
    )
    mine = place_of(me, groups)
    if is_timed:
        return LateObserver(property_, table, network, mine, others=others)
    return Observer(property_, table, network, mine, others=others)


def _not_violated(
    property_: ir.Property,
    model: Model,
    graph: Graph,
    groups: Sequence[Group],
    me: str | None,
    budget: Budget,
) -> Verdict:
    """Return the verdict when no violation was found."""
    states, full = len(graph.seen), tuple(sorted(graph.network.full))
    doubts = model.doubts(groups)
    if doubts:
        return Verdict(property_, "unknown", states, doubts[0].reason, doubts[0].place, me)
    if not graph.complete:
        reason = unfinished(model, budget)
        return Verdict(property_, "up to", states, reason, robot=me, full=full)
    return Verdict(property_, "holds", states, robot=me, full=full)


# ---- one robot, whatever the others do


def _is_alone(property_: ir.Property) -> bool:
    """Return True if a property is about one robot, and about what arrives from outside."""
    if property_.kind not in _SAFE:
        return False
    return all(isinstance(f, ir.Fact) and f.robots is None for f in facts_of(property_))


def _alone(property_: ir.Property, automaton: Local) -> int | None:
    """Prove a property of one robot that hears all messages at any time.

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
