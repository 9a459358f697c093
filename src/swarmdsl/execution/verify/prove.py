"""Proofs of properties: a search for a run that violates one, in the product with its monitor."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice

from swarmdsl import ir
from swarmdsl.base.records import replace
from swarmdsl.execution.monitor import Sentence
from swarmdsl.execution.verify.explore import Graph, observe
from swarmdsl.execution.verify.laps import endless
from swarmdsl.execution.verify.lassos import Lassos
from swarmdsl.execution.verify.limits import Budget
from swarmdsl.execution.verify.model import Model
from swarmdsl.execution.verify.monitor_table import MOST_CLAIMS, MonitorTable
from swarmdsl.execution.verify.moves import Move
from swarmdsl.execution.verify.network import Group, Network
from swarmdsl.execution.verify.observer import Observer
from swarmdsl.execution.verify.possible import prove_possible
from swarmdsl.execution.verify.quotient import Quotient
from swarmdsl.execution.verify.runs import Run, play, steps_between
from swarmdsl.execution.verify.terms import Terms, arriving, facts_of, is_act, roles_of
from swarmdsl.execution.verify.verdict import Outcome, Verdict, unfinished, violated
from swarmdsl.ir.sentences import facts_in

_SAFE = ("never", "always", "only", "times")
"""Patterns that a finite run violates."""
_LIVE = ("eventually", "leads", "then", "again")
"""Patterns that a run that goes on for ever can violate."""
_MOST_LASSOS = 60
"""Number of loops that are tried on the engine."""


def prove(property_: ir.Property, model: Model, budget: Budget) -> Verdict:
    """Look for a run that violates a property."""
    if property_.chance is not None and property_.chance.bound == "most":
        return Verdict(property_, "unknown", reason="a greatest probability is not covered")
    reason = not_covered(property_)
    if reason:
        return Verdict(property_, "unknown", reason=reason)
    if property_.each is None:
        return _one(property_, model, None, budget)
    found = [_one(property_, model, robot, budget) for robot in model.one_of_each(property_.each)]
    rank: dict[Outcome, int] = {"fails": 0, "unknown": 1, "up to": 2, "holds": 3}
    worst = min(found, key=lambda each: rank[each.outcome], default=None)
    if worst is None:
        return Verdict(property_, "holds", reason=f"there is no `{property_.each}`")
    return replace(worst, full=tuple(sorted({name for each in found for name in each.full})))


def not_covered(property_: ir.Property) -> str:
    """Return the reason why a property cannot be decided here, or ""."""
    if property_.within is not None:
        return "it is about time"
    scope = property_.scope.claims if property_.scope is not None else ()
    if len(property_.claims) + len(scope) > MOST_CLAIMS:
        return f"it has more than {MOST_CLAIMS} claims"
    facts = list(facts_in(property_.claims[0]))
    if property_.kind == "times" and any(map(is_act, facts)):
        mixed = not all(map(is_act, facts)) or _negates(property_.claims[0])
        # It would count the moments at which nothing of the kind happens.
        mixed |= any(map(_can_be_idle, facts))
        return "it counts what happens together with what is" if mixed else ""
    if property_.kind == "possible":
        if property_.scope is not None:
            return "`always possible` with a scope is not covered"
        if any(map(is_act, facts)):
            return "`always possible` is covered for states only"
    return ""


def _can_be_idle(fact: ir.Fact | ir.Count) -> bool:
    """Return True if a fact can hold for no robot: `no`, `all` of none, `0..2`."""
    robots = fact.robots if isinstance(fact, ir.Fact) else None
    if robots is None:
        return False
    least = robots.number.lower if robots.number is not None else 1
    return robots.quantifier in ("no", "all") or least == 0


def _negates(claim: ir.Claim) -> bool:
    if not isinstance(claim, ir.Junction):
        return False
    return claim.operator == "not" or any(map(_negates, claim.claims))


def _one(property_: ir.Property, model: Model, me: str | None, budget: Budget) -> Verdict:
    """Decide on a property, of one robot if it is about each."""
    if is_about_ends(property_):
        return _in_the_end(property_, model, me, budget)
    every = model.groups([property_], me=me)
    mine = next((n for n, g in enumerate(every) if me is not None and g.robots == (me,)), None)
    seen = set(about(property_, model, every))
    if mine is not None:
        seen.add(mine)
    groups = model.cone(every, seen) or every
    is_sure = model.complete and not model.doubts(groups)
    if mine is not None and is_sure and _is_alone(property_):
        states = _alone(property_, every[mine].automaton)
        if states is not None:
            return Verdict(property_, "holds", states, robot=me, alone=True)
    if property_.kind == "possible":
        place = groups.index(every[mine]) if mine is not None else None
        return prove_possible(property_, model, groups, place, me, budget)
    observer = observer_of(property_, model, groups, me, others=len(groups) < len(every))
    graph = observe(observer.network, observer, budget)
    if graph.bad is not None and observer.others:
        # Whether others act at that moment is known only with all of them.
        groups = every
        observer = observer_of(property_, model, groups, me, others=False)
        graph = observe(observer.network, observer, budget)
    if graph.bad is not None:
        return violated(property_, _run(property_, observer, graph, graph.bad), graph, me)
    return _not_violated(property_, model, graph, groups, me, budget)


def is_about_ends(property_: ir.Property) -> bool:
    """Return True if runs that go on for ever can violate a property."""
    scope = property_.scope.kind if property_.scope is not None else None
    return property_.kind in _LIVE and scope not in ("before", "between")


def _in_the_end(property_: ir.Property, model: Model, me: str | None, budget: Budget) -> Verdict:
    """Decide on a property that runs that go on for ever can violate.

    If robots of a group must be told apart to decide, each is looked at by itself.
    """
    flaw = ""
    for single in (False, True):
        every = model.groups([property_], me=me, tasks=True, single=single)
        seen = set(about(property_, model, every))
        seen |= {number for number, group in enumerate(every) if group.robots == (me,)}
        groups = model.cone(every, seen) or every
        observer = observer_of(property_, model, groups, me, others=len(groups) < len(every))
        if observer.others:
            # What holds for a moment ends when any robot does something.
            groups = every
            observer = observer_of(property_, model, groups, me, others=False)
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
    reason = f"the run that was found cannot be: {flaw}"
    return Verdict(property_, "unknown", len(graph.seen), reason, robot=me)


def _run(property_: ir.Property, observer: Observer, graph: Graph, bad: int) -> Run:
    """Return a run to a state that violates a property, at once or if nothing follows."""
    way = graph.way(bad)
    steps = steps_between(way, lambda state: list(observer.successors(state)))
    run = play(observer.network, steps, property_)
    return run if observer.is_bad(way[-1]) else replace(run, loop=0)


def observer_of(
    property_: ir.Property, model: Model, groups: Sequence[Group], me: str | None, *, others: bool
) -> Observer:
    """Return the observer of a property in some groups, of one robot if it is about each."""
    table = table_of(property_)
    network = Network(
        groups,
        model.alphabet,
        model.options.capacity,
        lossy=model.options.lossy,
        base=max(table.size, 2).bit_length(),
    )
    mine = next((n for n, g in enumerate(groups) if me is not None and g.robots == (me,)), None)
    return Observer(property_, table, network, mine, others=others)


def about(property_: ir.Property, model: Model, groups: Sequence[Group]) -> Iterator[int]:
    """Yield the groups that the facts of a property are about."""
    for fact in facts_of(property_):
        roles = roles_of(fact, property_)
        for number, group in enumerate(groups):
            if isinstance(fact, ir.Fact) and fact.act == "arrives":
                if fact.name in group.automaton.whole.kind.outside:
                    yield number
            elif isinstance(fact, ir.Fact) and fact.robots is None and property_.each is not None:
                continue
            elif not roles or group.role in roles:
                yield number


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


def _sentence(property_: ir.Property) -> Sentence:
    scope = property_.scope
    momentary = any(map(is_act, facts_in(property_.claims[0])))
    kind = scope.kind if scope is not None else None
    return Sentence(property_.kind, kind, None, property_.times, momentary=momentary)


def table_of(property_: ir.Property) -> MonitorTable:
    """Return the monitor of a property."""
    scope = property_.scope.claims if property_.scope is not None else ()
    return MonitorTable(_sentence(property_), len(property_.claims), len(scope))


# ---- one robot, whatever the others do


def _is_alone(property_: ir.Property) -> bool:
    """Return True if a property is about one robot, and about what arrives from outside."""
    if property_.kind not in _SAFE:
        return False
    return all(isinstance(f, ir.Fact) and f.robots is None for f in facts_of(property_))


def _alone(property_: ir.Property, automaton: Quotient) -> int | None:
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
        for message in range(len(automaton.whole.alphabet.messages)):
            heard = automaton.move_on(state, message)
            if heard is not None:
                moves.append(heard)
        found |= {(move.target, after(memory, move)) for move in moves}
        todo += found - seen
        seen |= found
    return len(seen)
