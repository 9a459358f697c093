"""Truth of claims in a run, and for how many robots they hold."""

from __future__ import annotations

import operator
from collections.abc import Callable, Collection, Iterable, Mapping
from typing import Any

from .claims import Claim, Count, Fact, Junction, Robots, facts_in
from .facts import MOMENTARY, ActorLike, FactTracker, Has

Truth = Callable[[str | None], bool]
"""Truth of a claim, for the robot of `each`."""
Number = Callable[[str | None], int]
"""Number of robots for which a claim holds, likewise."""
COMPARISONS: Mapping[str, Callable[[Any, Any], bool]] = {
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}


class Trackers:
    """Trackers of facts, shared by all sentences about a run; `has` evaluates conditions."""

    def __init__(self, has: Has) -> None:
        self._has = has
        self._known: dict[tuple[object, ...], FactTracker] = {}

    def of(self, fact: Fact | Count, role: str | None) -> FactTracker:
        """Return the tracker of a fact of a role, or of all roles."""
        if isinstance(fact, Count):
            key: tuple[object, ...] = ("in", fact.state, role, None)
        else:
            key = (fact.act, fact.name, role, fact.condition)
        if key not in self._known:
            self._known[key] = FactTracker(fact, role, self._has)
        return self._known[key]

    def following(self, actor: ActorLike) -> list[FactTracker]:
        """Return the trackers of facts that lines of an actor can change."""
        return [each for each in self._known.values() if each.follows(actor)]


class Claims:
    """Claims of one sentence about a swarm, or about each robot of a role."""

    def __init__(self, each: str | None, trackers: Trackers) -> None:
        self.trackers: dict[FactTracker, None] = {}
        self._each = each
        self._all = trackers
        self._shared: set[FactTracker] = set()
        """Facts that are not only about the robot of `each`."""

    def affected(
        self,
        changed: Mapping[FactTracker, set[str | None]],
        robots: Collection[str | None],
    ) -> Iterable[str | None]:
        """Return those of some robots for which a claim can have changed."""
        if self._each is None or not self._shared.isdisjoint(changed):
            return robots
        if len(changed) == 1:
            (found,) = changed.values()
        else:
            found = set().union(*(changed[each] for each in self.trackers if each in changed))
        return [robot for robot in found if robot in robots]

    def number(self, claim: Claim) -> Number:
        """Return for how many robots a claim holds; 0 or 1 if it is not about every one."""
        robots = claim.robots if isinstance(claim, Fact) else None
        if isinstance(claim, Fact) and robots is not None and robots.quantifier == "every":
            tracker = self._tracker(claim, shared=True)
            return lambda me: len(tracker.holding)
        truth = self.truth(claim)
        return lambda me: int(truth(me))

    def truth(self, claim: Claim) -> Truth:
        """Return the truth of a claim."""
        if isinstance(claim, Junction):
            parts = [self.truth(each) for each in claim.claims]
            if claim.operator == "not":
                (part,) = parts
                return lambda me: not part(me)
            together = all if claim.operator == "and" else any
            return lambda me: together(part(me) for part in parts)
        own = isinstance(claim, Fact) and claim.robots is None and claim.act != "arrives"
        own = own and self._each is not None
        tracker = self._tracker(claim, shared=not own)
        if isinstance(claim, Count):
            compare, number = COMPARISONS[claim.comparison], claim.number
            return lambda me: compare(len(tracker.holding), number)
        if own:
            return lambda me: me in tracker.holding
        if claim.robots is not None:
            return _of_robots(claim.robots, tracker)
        return lambda me: bool(tracker.holding)

    def _tracker(self, fact: Fact | Count, *, shared: bool) -> FactTracker:
        tracker = self._all.of(fact, self._role(fact))
        self.trackers[tracker] = None
        if shared:
            self._shared.add(tracker)
        return tracker

    def _role(self, fact: Fact | Count) -> str | None:
        """Return the role whose robots a fact is about, None for all."""
        if isinstance(fact, Count):
            return fact.role
        if fact.act == "arrives":
            return None
        return fact.robots.role if fact.robots is not None else self._each


def is_momentary(claim: Claim) -> bool:
    """Return True if a claim is about what happens, not only about what is."""
    acts = {each.act for each in facts_in(claim) if isinstance(each, Fact)}
    return not acts.isdisjoint(MOMENTARY)


def _of_robots(robots: Robots, tracker: FactTracker) -> Truth:
    if robots.quantifier == "index":
        name = f"{robots.role}[{robots.number}]"
        return lambda me: name in tracker.holding
    if robots.quantifier == "number":
        least, most = robots.least, robots.most
        return lambda me: (
            least <= len(tracker.holding) and (most is None or len(tracker.holding) <= most)
        )

    def count(me: str | None) -> int:
        return len(tracker.holding) - (robots.other and me in tracker.holding)

    if robots.quantifier == "some":
        return lambda me: count(me) > 0
    if robots.quantifier == "no":
        return lambda me: count(me) == 0
    return lambda me: count(me) == len(tracker.robots) - (robots.other and me in tracker.robots)
