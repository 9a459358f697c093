"""Proofs of properties: a search for a run that violates one, in the product with its monitor."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl import ir
from swarmdsl.base.records import replace
from swarmdsl.execution.verify.automata.limits import Budget, LimitReachedError
from swarmdsl.execution.verify.proofs.liveness import in_the_end
from swarmdsl.execution.verify.proofs.observation import observer_of, run_to
from swarmdsl.execution.verify.proofs.overapproximation import with_open_data
from swarmdsl.execution.verify.proofs.possible import prove_possible
from swarmdsl.execution.verify.proofs.single_robot import (
    Alone,
    distances,
    hearing_all,
    is_alone,
    without_others,
)
from swarmdsl.execution.verify.proofs.timed import not_with_clocks, prove_exactly, seek_late
from swarmdsl.execution.verify.proofs.verdict import (
    ESTIMATE,
    UNSURE,
    Verdict,
    at_limit,
    not_run,
    not_violated,
    violated,
    worst,
)
from swarmdsl.execution.verify.properties.observer import Observer
from swarmdsl.execution.verify.properties.sentence import is_about_ends, not_shown
from swarmdsl.execution.verify.replay.spurious import OPEN
from swarmdsl.execution.verify.search.explore import Graph, observe
from swarmdsl.execution.verify.search.nearest import observe_nearest
from swarmdsl.execution.verify.search.relaxed_plan import observe_planned
from swarmdsl.execution.verify.swarm.groups import Group
from swarmdsl.execution.verify.swarm.influence import cone
from swarmdsl.execution.verify.swarm.model import Model
from swarmdsl.execution.verify.swarm.subjects import DEADLINES, about, expects_in_time, place_of

_MOST_NEAR = 2_000
"""Number of states among which a loop is looked for if a property is about time."""


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
        return _within_limits(property_, model, None, budget)
    robots = model.one_of_each(property_)
    found = [_within_limits(property_, model, robot, budget) for robot in robots]
    decisive = worst(found)
    if decisive is None:
        return Verdict(property_, "holds", reason=f"there is no `{property_.each}`")
    return replace(decisive, full=tuple(sorted({name for each in found for name in each.full})))


def _within_limits(property_: ir.Property, model: Model, me: str | None, budget: Budget) -> Verdict:
    try:
        return _one(property_, model, me, budget)
    except LimitReachedError:
        return Verdict(property_, "unknown", reason=at_limit(budget), robot=me)


def _one(property_: ir.Property, model: Model, me: str | None, budget: Budget) -> Verdict:
    """Decide on a property, of one robot if it is about each."""
    verdict = _without_clocks(property_, model, me, budget)
    if verdict.reason in map(not_run, OPEN) and property_.kind != "possible":
        # A longer run, in which robots are far from each other and hear of all, may violate it.
        again = _without_clocks(property_, model, me, budget, lonely=True)
        verdict = again if again.outcome == "fails" else verdict
    if verdict.outcome not in ("unknown", "up to"):
        return verdict
    late = _never(property_, model, me, budget)
    if late is not None:
        return late
    has_clocks = model.options.exact and not model.environment.faults
    if has_clocks and verdict.outcome == "unknown" and verdict.place is None:
        verdict = prove_exactly(property_, model, me, budget, verdict)
    elif has_clocks and verdict.outcome == "up to" and not model.complete:
        # A robot with clocks may have fewer states than one that hears anything at any time.
        timed = prove_exactly(property_, model, me, budget, verdict)
        verdict = timed if timed.outcome in ("holds", "fails") else verdict
    if verdict.outcome in ("holds", "fails"):
        return verdict
    late = seek_late(property_, model, me, budget)
    if late is not None:
        return late
    if has_clocks or verdict.outcome == "up to" or verdict.place is not None:
        return verdict
    way_out = ""
    doubt = not_with_clocks(property_, _wider(property_, model, budget) or model, me)
    if doubt is not None and property_.within is not None:
        way_out = f"; clocks do not decide: {doubt.reason}"
        verdict = replace(verdict, place=doubt.place)
    elif model.options.exact:
        way_out = "; clocks are for robots that are not lost: try `--faults 0`"
    elif property_.within is not None and model.environment.faults:
        way_out = "; without losses, try `--time exact --faults 0`"
    elif property_.within is not None:
        way_out = "; try `--time exact`"
    return replace(verdict, reason=verdict.reason + way_out)


def _loosely(
    property_: ir.Property, model: Model, me: str | None, budget: Budget
) -> Verdict | None:
    """Return the verdict if a property holds whatever the data are that are not all covered.

    It may hold up to a number of states only.
    """
    looser = _wider(property_, model, budget)
    if looser is None:
        return None
    found = _without_clocks(property_, looser, me, budget)
    if found.outcome != "holds" and property_.within is not None and model.options.exact:
        found = prove_exactly(property_, looser, me, budget, found)
    open_ = found.open or looser.open
    return replace(found, open=open_) if found.outcome in ("holds", "up to") else None


def _wider(property_: ir.Property, model: Model, budget: Budget) -> Model | None:
    """Return the model with open data that may decide on a property, if there is one."""
    if property_.kind == "possible" or property_.chance is not None or model.open:
        return None
    found = with_open_data(model, budget)
    return found if found is not None and property_ in found.properties else None


def _never(property_: ir.Property, model: Model, me: str | None, budget: Budget) -> Verdict | None:
    """Return a verdict if what must happen in time need not happen at all: a loop shows it."""
    endless = replace(property_, within=None, chance=None)
    if property_.within is None or not is_about_ends(endless):
        return None
    some = budget.some(_MOST_NEAR)
    found = in_the_end(endless, model, me, some, lonely=False, timed=True)
    if found.run is None:
        return None
    if property_.chance is not None:
        return Verdict(property_, "unknown", found.states, UNSURE, robot=me)
    return replace(found, property=property_)


def _without_clocks(
    property_: ir.Property, model: Model, me: str | None, budget: Budget, *, lonely: bool = False
) -> Verdict:
    """Decide on a property for functions and delays that take any time.

    With `lonely`, only runs are looked at in which nobody is near another robot, or takes one for
    lost that it could hear.
    """
    every = model.groups([property_], me=me)
    mine = place_of(me, every)
    seen = set(about(property_, model, every))
    if mine is not None:
        seen.add(mine)
    groups = cone(model, every, seen) or every
    is_sure = model.complete and not model.doubts(groups)
    if mine is not None and is_alone(property_):
        if is_sure:
            states = hearing_all(property_, every[mine].automaton)
            if states is not None:
                return Verdict(property_, "holds", states, robot=me, alone=True)
        elif (found := without_others(property_, model, me, budget)) is not None:
            return found
    loose = _loosely(property_, model, me, budget) if not is_sure else None
    if loose is not None and loose.outcome == "holds":
        return loose
    if is_about_ends(property_):
        found = in_the_end(property_, model, me, budget, lonely=lonely)
    elif property_.kind == "possible":
        place = groups.index(every[mine]) if mine is not None else None
        network = model.network(groups, spared=me)
        found = prove_possible(property_, model, network, place, me, budget)
    else:
        found = _searched(property_, model, groups, every, me, budget, lonely=lonely)
    return loose if loose is not None and found.outcome == "unknown" else found


def _searched(
    property_: ir.Property,
    model: Model,
    groups: Sequence[Group],
    every: Sequence[Group],
    me: str | None,
    budget: Budget,
    *,
    lonely: bool,
) -> Verdict:
    """Look for a finite run of some groups that violates a property, or of all robots."""
    in_time = expects_in_time(model, every)
    others = len(groups) < len(every) or in_time
    observer = observer_of(property_, model, groups, me, lonely=lonely, others=others)
    graph = observe(observer.network, observer, budget)
    if graph.bad is not None and observer.others:
        # Whether others act at that moment is known only with all of them.
        groups = every
        observer = observer_of(property_, model, groups, me, lonely=lonely, others=False)
        graph = observe(observer.network, observer, budget)
        if graph.bad is None and in_time:
            return Verdict(property_, "unknown", len(graph.seen), DEADLINES, robot=me)
    if graph.bad is None:
        near = None
        if not graph.complete and not budget.is_over():
            all_or_some = every if observer.others else groups
            near = _near(property_, model, all_or_some, me, budget, lonely=lonely)
        return near or not_violated(property_, model, graph, groups, me, budget)
    found = violated(property_, run_to(property_, observer, graph, graph.bad), graph, me)
    if found.run is None and property_.chance is None:
        # A longer run, in which messages arrive first, may be one that can be.
        observer = observer_of(
            property_, model, groups, me, lonely=lonely, others=observer.others, eager=True
        )
        graph = observe(observer.network, observer, budget)
        if graph.bad is not None:
            again = violated(property_, run_to(property_, observer, graph, graph.bad), graph, me)
            found = again if again.run is not None else found
    return found


def _near(
    property_: ir.Property,
    model: Model,
    groups: Sequence[Group],
    me: str | None,
    budget: Budget,
    *,
    lonely: bool,
) -> Verdict | None:
    """Look for a run to a violation by the robot that a property is about.

    First with the moves of a plan, then where the robot has few steps to violate it.
    """
    mine = place_of(me, groups)
    if mine is None or not is_alone(property_):
        return None
    automaton = groups[mine].automaton
    # A run in which robots are far from each other may be one that can be.
    for far in dict.fromkeys((lonely, True)):
        if budget.is_over():
            return None
        observer = observer_of(property_, model, groups, me, lonely=far, others=False)
        graph = observe_planned(observer, mine, Alone(property_, automaton), budget)
        found = _tried(property_, observer, graph, me)
        if found is not None:
            return found
    if budget.is_over():
        return None
    observer = observer_of(property_, model, groups, me, lonely=lonely, others=False)
    graph = observe_nearest(observer, mine, distances(property_, automaton), budget)
    return _tried(property_, observer, graph, me)


def _tried(
    property_: ir.Property, observer: Observer, graph: Graph, me: str | None
) -> Verdict | None:
    """Return the verdict of a search that does not look for a shortest run, if it can be played."""
    if graph.bad is None:
        return None
    run = replace(run_to(property_, observer, graph, graph.bad), shortest=False)
    found = violated(property_, run, graph, me)
    return found if found.run is not None else None
