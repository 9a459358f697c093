"""Proofs for every number of robots of a role."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any

from swarmdsl import ir
from swarmdsl.base.records import replace
from swarmdsl.execution.simulate.network.members import DEPARTED
from swarmdsl.execution.verify.abstraction.doubt import Doubt
from swarmdsl.execution.verify.any_size.cover_problem import Bounds, question
from swarmdsl.execution.verify.any_size.coverability import Cover, cover
from swarmdsl.execution.verify.any_size.upward_closed import NotCoveredError
from swarmdsl.execution.verify.automata.limits import Budget, LimitReachedError
from swarmdsl.execution.verify.proofs.single_robot import hearing_all, is_alone
from swarmdsl.execution.verify.proofs.verdict import (
    ESTIMATE,
    Verdict,
    at_limit,
    unfinished,
    worst,
)
from swarmdsl.execution.verify.properties.sentence import is_about_ends, not_covered
from swarmdsl.execution.verify.swarm.groups import Group
from swarmdsl.execution.verify.swarm.influence import cone
from swarmdsl.execution.verify.swarm.model import Model
from swarmdsl.execution.verify.swarm.propositions import facts_of
from swarmdsl.execution.verify.swarm.subjects import about, place_of

_SPARE = 3
"""Robots of a role beyond the least number, so that some are left that nothing tells apart."""


def enough(bounds: Bounds, faults: int = 0) -> dict[str, int]:
    """Return numbers of robots that show all kinds of robots of swarms of any size.

    Each of them has others that can be lost, as many as `faults`.
    """
    return {role: least + max(_SPARE, faults + 1) for role, (least, _) in bounds.items()}


def prove_any(
    property_: ir.Property,
    model: Model,
    bounds: Bounds,
    budget: Budget,
    prove_at: Callable[[Mapping[str, int]], Verdict],
) -> Verdict:
    """Prove a property for every number of robots of some roles.

    The model has `enough` of them. `prove_at` proves it for given numbers of these roles: a
    violation is found by a search among so many.
    """
    try:
        return _prove_any(property_, model, bounds, budget, prove_at)
    except LimitReachedError:
        return Verdict(property_, "unknown", reason=at_limit(budget))


def _prove_any(
    property_: ir.Property,
    model: Model,
    bounds: Bounds,
    budget: Budget,
    prove_at: Callable[[Mapping[str, int]], Verdict],
) -> Verdict:
    if property_.chance is not None and property_.chance.bound == "most":
        return Verdict(
            property_, "unknown", reason=f"a greatest probability is not covered: {ESTIMATE}"
        )
    reason = not_covered(property_)
    if is_about_ends(property_):
        reason = reason or "it is about what must happen"
    elif property_.kind == "possible":
        reason = reason or "it is about what is possible"
    differing = differs(property_, model, bounds)
    robots = model.one_of_each(property_)
    if property_.kind == "leads" and differing is None:
        answered = _answered_at_once(property_, model, bounds, robots)
        if answered is not None:
            return answered
    # What is done in the same step could be proved if robots were alike.
    is_alike = property_.kind != "leads" or differing is None
    doubt = Doubt(reason) if reason and is_alike else differing
    if doubt is not None:
        return _smallest(property_, model, bounds, doubt, prove_at)
    found = [_one(property_, model, bounds, me, budget, prove_at) for me in robots]
    return worst(found) or Verdict(property_, "holds", reason=f"there is no `{property_.each}`")


def _answered_at_once(
    property_: ir.Property, model: Model, bounds: Bounds, robots: Sequence[str | None]
) -> Verdict | None:
    """Prove what robots must do, if each does it in the same step, whatever the others do."""
    if not is_alone(property_) or not model.complete:
        return None
    looked = 0
    for me in robots:
        groups = model.groups([property_], me=me)
        mine = place_of(me, groups)
        if mine is None or model.doubts(groups):
            return None
        states = hearing_all(property_, groups[mine].automaton)
        if states is None:
            return None
        looked += states
    return Verdict(property_, "holds", looked, _every(bounds)) if robots else None


def differs(property_: ir.Property, model: Model, bounds: Bounds) -> Doubt | None:
    """Return the reason why swarms of other sizes may have other kinds of robots, or None."""
    if model.demands.identity:
        return Doubt("robots are told apart, by who they are or who has sent an event")
    if model.returns or model.guesses:
        return Doubt("lost robots come back, or heartbeats may be lost")
    for actor in model.cast:
        machine = model.machines[actor.machine.name]
        place = _place_of(machine, _is_count)
        if place is not None and actor.robot.role in bounds:
            return Doubt(f"the behavior depends on the number of `{actor.robot.role}`", *place)
        place = _place_of(machine, lambda tree: _counts_present(tree, bounds))
        if place is not None:
            return Doubt("the behavior depends on how many robots are present", *place)
        place = _place_of(machine, _counts_near)
        if place is not None:
            return Doubt("the behavior depends on how many robots are near", *place)
    are_told = any(kind.kind.listens(DEPARTED) for kind in model.kinds)
    for role, (least, _) in bounds.items():
        declared = next(each for each in _roles(model) if each.name == role)
        place = declared.origin
        if are_told and model.environment.faults >= model.counts[role]:
            return Doubt(f"any number of `{role}` can be lost, and others are told", place)
        unseen = any(each.index >= model.counts[role] for each in declared.robots)
        if unseen or sum(kind.kind.role == role for kind in model.kinds) > 1:
            return Doubt(f"robots of `{role}` differ in their params", place)
        for name in sorted(model.named([property_]) | model.environment.named):
            index = name.removeprefix(f"{role}[").removesuffix("]")
            if index.isdigit() and int(index) >= least:
                return Doubt(f"`{name}` is there in larger swarms only", place)
    for fact in facts_of(property_):
        if (
            isinstance(fact, ir.Fact)
            and fact.guard is not None
            and _place_of(fact.guard, _is_count)
        ):
            return Doubt("it is about the number of robots", property_.origin)
    return None


def _roles(model: Model) -> Sequence[ir.Role]:
    return model.subject.swarm.roles if model.subject.swarm is not None else ()


def _is_count(tree: Any) -> bool:
    """Return True for the number of robots of one's own role."""
    return isinstance(tree, ir.SelfField) and tree.field == "count"


def _counts_near(tree: Any) -> bool:
    """Return True for the number of robots nearby."""
    return isinstance(tree, ir.Call) and tree.function == "neighbors"


def _counts_present(tree: Any, bounds: Bounds) -> bool:
    """Return True for the number of present robots, of some roles or of all."""
    if not isinstance(tree, ir.Call) or tree.function != "present":
        return False
    roles = [each.value for each in tree.arguments if isinstance(each, ir.Literal)]
    return not roles or any(role in bounds for role in roles)


def _place_of(tree: Any, is_meant: Callable[[Any], bool]) -> tuple[Any, ...] | None:
    """Return the place of an expression in a tree, or None."""
    if is_meant(tree):
        return (tree.origin,)
    if isinstance(tree, tuple):
        parts: Sequence[Any] = tree
    elif is_dataclass(tree):
        parts = [getattr(tree, each.name) for each in fields(tree)]
    else:
        return None
    found = (_place_of(each, is_meant) for each in parts)
    return next((each for each in found if each is not None), None)


def _smallest(
    property_: ir.Property,
    model: Model,
    bounds: Bounds,
    doubt: Doubt,
    prove_at: Callable[[Mapping[str, int]], Verdict],
) -> Verdict:
    """Prove a property for the smallest swarm, if it cannot be decided for every number."""
    counts = {role: least for role, (least, _) in bounds.items()}
    verdict = prove_at(counts)
    size = ", ".join(f"{number} {role}" for role, number in counts.items())
    if verdict.outcome == "fails":
        return replace(verdict, reason=f"of {size}", size=counts)
    reason = f"not covered for every number: {doubt.reason}"
    if verdict.outcome == "holds":
        role, (least, most) = next(iter(bounds.items()))
        most = least + 2 if most is None else min(least + 2, most)
        reason += f"; it holds for {size}: try more, as `--size {role}={least}..{most}`"
    elif verdict.reason:
        reason += f"; for {size}, {verdict.reason}"
    return Verdict(property_, "unknown", verdict.states, reason, doubt.place, full=verdict.full)


def _one(
    property_: ir.Property,
    model: Model,
    bounds: Bounds,
    me: str | None,
    budget: Budget,
    prove_at: Callable[[Mapping[str, int]], Verdict],
) -> Verdict:
    """Decide on a property, of one robot if it is about each."""
    budget.check()
    every = model.groups([property_], me=me)
    mine = place_of(me, every)
    seen = set(about(property_, model, every))
    if mine is not None:
        seen.add(mine)
    groups = cone(model, every, seen) or every
    try:
        asked = question(property_, model, bounds, groups, me)
    except NotCoveredError as error:
        return _smallest(property_, model, bounds, Doubt(str(error)), prove_at)
    found = Cover(None, 0, complete=True)
    if asked is not None:
        found = cover(asked.swarm, asked.wanted, budget, asked.at_start)
    if budget.interrupted:
        return Verdict(property_, "unknown", found.looked, at_limit(budget), robot=me)
    if found.numbers is not None:
        return _violated(property_, model, bounds, groups, found, prove_at, me)
    doubts = model.doubts(groups)
    if doubts:
        return Verdict(property_, "unknown", found.looked, doubts[0].reason, doubts[0].place, me)
    if not (found.complete and model.complete):
        return Verdict(property_, "unknown", found.looked, unfinished(model, budget), robot=me)
    return Verdict(property_, "holds", found.looked, _every(bounds), robot=me)


def _every(bounds: Bounds) -> str:
    numbers = (
        f"{least} or more {role}" if most is None else f"{least} to {most} {role}"
        for role, (least, most) in bounds.items()
    )
    return f"for {', '.join(numbers)}, however many events are on their way"


def _violated(
    property_: ir.Property,
    model: Model,
    bounds: Bounds,
    groups: Sequence[Group],
    found: Cover,
    prove_at: Callable[[Mapping[str, int]], Verdict],
    me: str | None,
) -> Verdict:
    """Search for a violation with the smallest number of robots that it may take."""
    numbers = dict.fromkeys(bounds, 0)
    for group, number in zip(groups, found.numbers or (), strict=True):
        if group.role in numbers:
            numbers[group.role] += number
    # Roles that have no say may be as small as they can.
    counts = {r: max(n, bounds[r][0]) for r, n in numbers.items()}
    verdict = prove_at(counts)
    size = ", ".join(f"{number} {role}" for role, number in counts.items())
    if verdict.outcome == "fails":
        return replace(verdict, reason=f"it takes {size}", size=counts)
    reason = f"{size} might violate it"
    if verdict.reason:
        reason += f": {verdict.reason}"
    elif verdict.outcome == "holds":
        most = model.options.capacity
        reason += (
            f", but not with at most {most} of an event on the way: try `--channel {most + 1}`"
        )
    return Verdict(property_, "unknown", verdict.states, reason, verdict.place, me)
