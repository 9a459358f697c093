"""Paths to safe states: what robots do by themselves after an event.

By itself, a robot completes activities, states and regions, waits for times, and takes guards and
its own events: all of them are assumed to be possible, and to take no time but for delays that
are constants. Events of others are no part of a path.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence, Set
from heapq import heappop, heappush
from itertools import count

from swarmdsl.analysis.checks.state_places import Place
from swarmdsl.analysis.types.constant_folding import Folding
from swarmdsl.base.diagnostics.advice import behind, edits
from swarmdsl.syntax.ast import (
    Activity,
    Choice,
    Contract,
    DoneTrigger,
    Event,
    EventTrigger,
    History,
    OutcomeTrigger,
    Parallel,
    Region,
    State,
    TimeTrigger,
    Transition,
    Trigger,
)

Step = tuple[Place, int, Transition | None]
"""Next place, the time until then in nanoseconds at least, and the transition that leads there."""


class SafePaths:
    """Paths of one machine to `safe` places; `sent` are the events that the machine sends."""

    def __init__(self, safe: Sequence[Place], sent: Set[Event], folding: Folding) -> None:
        self._safe = set(safe)
        self._sent = sent
        self._folding = folding

    def is_safe(self, place: Place) -> bool:
        """Return True for a safe place, or one inside it."""
        return any(each in self._safe for each in place.chain())

    def settles(self, place: Place, seen: frozenset[Place] = frozenset()) -> bool:
        """Return True if the robot is in a safe place as soon as it is in this one."""
        if self.is_safe(place):
            return True
        after = [each for each, _, _ in self._inner(place)]
        if isinstance(place.node, Parallel):
            return any(self.settles(each, seen | {place}) for each in after if each not in seen)
        return bool(after) and all(
            each not in seen and self.settles(each, seen | {place}) for each in after
        )

    def time(self, origin: Place, running: Set[Place]) -> int | None:
        """Return the least time to a safe place; None if no path leads there.

        The delays of places that were `running` before may be over at once.
        """
        order = count()
        ahead = [(0, next(order), origin)]
        done: set[Place] = set()
        while ahead:
            time, _, place = heappop(ahead)
            if self.is_safe(place):
                return time
            if place in done:
                continue
            done.add(place)
            for following, delay, transition in self.steps(place):
                waits = delay if transition is None or not self._is_of(transition, running) else 0
                heappush(ahead, (time + waits, next(order), following))
        return None

    def reached(self, origins: Iterable[Place]) -> set[Place]:
        """Return the places in which a robot may be on its way from others, up to safe ones."""
        ahead, found = [*origins], set[Place]()
        while ahead:
            place = ahead.pop()
            if place not in found:
                found.add(place)
                if not self.is_safe(place):
                    ahead += [each for each, _, _ in self.steps(place)]
        return found

    def leads(self, origin: Place) -> bool:
        """Return True if a robot goes on by itself, to safe places only, whatever happens.

        It may take a while, and come by a place several times.
        """
        ahead, done = [origin], set[Place]()
        while ahead:
            place = ahead.pop()
            if place in done or self.is_safe(place):
                continue
            done.add(place)
            steps = [*self.steps(place)]
            own = {transition for _, _, transition in steps}
            if not any(each is None or each.guard is None for each in own):
                return False
            ahead += [each for each, _, _ in steps]
            for owner in place.chain():
                others = (each for each in owner.transitions() if each not in own)
                targets = (owner.target(each.target) for each in others)
                ahead += [each for each in targets if each is not None]
        return True

    def leaving(self) -> Iterator[tuple[Place, Transition]]:
        """Yield transitions that a robot in a safe place takes by itself to one that is not."""
        for safe in self._safe:
            for leaf in safe.leaves():
                for target, _, transition in self.steps(leaf):
                    if transition is not None and not self.settles(target):
                        yield leaf, transition

    def steps(self, place: Place) -> Iterator[Step]:
        """Yield what a robot in a place, and in those around it, does by itself."""
        yield from self._inner(place)
        for owner in place.chain():
            for transition in owner.transitions():
                target = owner.target(transition.target)
                if target is None:
                    continue
                triggers = transition.triggers
                if not triggers:
                    yield target, 0, transition
                for trigger in triggers:
                    if self._comes(trigger, owner, place):
                        yield target, self._delay(trigger), transition

    def _inner(self, place: Place) -> Iterator[Step]:
        """Yield the places that are entered with a place, or follow at once."""
        found: list[Place | None]
        match place.node:
            case Choice(branches=branches):
                found = [place.target(branch.target) for branch in branches]
            case History() as history:
                siblings = place.around.inside if place.around is not None else []
                others = [each for each in siblings if not isinstance(each.node, (Choice, History))]
                found = [*others] if history.target is None else [place.target(history.target)]
            case _:
                found = [*place.first()]
        for each in found:
            if each is not None:
                yield each, 0, None

    def _comes(self, trigger: Trigger, owner: Place, place: Place) -> bool:
        """Return True if a trigger comes by itself while a robot is in a place."""
        match trigger:
            case OutcomeTrigger():
                items = owner.node.items if isinstance(owner.node, State) else []
                return any(isinstance(item, Activity) for item in items)
            case DoneTrigger():
                return _completes(trigger, owner, place)
            case TimeTrigger():
                return True
            case EventTrigger(event=event):
                return event.target in self._sent
        return False

    def _delay(self, trigger: Trigger) -> int:
        tree = trigger.delay.tree if isinstance(trigger, TimeTrigger) else None
        value = self._folding.value(tree) if tree is not None else None
        return round(value) if isinstance(value, (int, float)) else 0

    @staticmethod
    def _is_of(transition: Transition, places: Set[Place]) -> bool:
        return any(transition in place.transitions() for place in places)


def _completes(trigger: DoneTrigger, owner: Place, place: Place) -> bool:
    """Return True if a robot in a place may complete its state, or a region of it."""
    if not place.is_final or place.around is None:
        return False
    if trigger.final is not None and trigger.final.target is not place.node:
        return False
    around = place.around
    if not isinstance(around.node, Region):
        return around is owner
    of_region = trigger.region is None or trigger.region.target is around.node
    return around.around is owner and of_region


def is_left_at_once(place: Place) -> bool:
    """Return True for a place in which no event finds a robot: it goes on without one, for sure."""
    for owner in place.chain():
        for transition in owner.transitions():
            triggers = transition.triggers
            if transition.guard is None and (
                not triggers or any(_ends(each, owner, place) for each in triggers)
            ):
                return True
    return False


def _ends(trigger: Trigger, owner: Place, place: Place) -> bool:
    """Return True if a place completes its state, or the region that the trigger names."""
    if not isinstance(trigger, DoneTrigger) or not _completes(trigger, owner, place):
        return False
    is_region = place.around is not None and isinstance(place.around.node, Region)
    return not is_region or trigger.region is not None


def also_safe(contract: Contract, transition: Transition) -> str:
    """Return the help for a transition that leaves the safe states by itself."""
    text = "let it wait for an event, or name the state that it leads to as safe, too"
    if transition.target is None or "." in transition.target.name:
        return text
    name, last = transition.target.name, contract.states[-1].span
    return edits(text, f"Add `{name}` to the safe states", behind(last, f", {name}"))
