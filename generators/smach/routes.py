"""Where the outcomes of a SMACH state lead."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from swarmdsl.dataclass import dataclass, replace
from swarmdsl.ir import DoneTrigger, OutcomeTrigger, State, Transition, Trigger

from .module import CANCELLED, PREEMPTED
from .python import Call
from .statements import effects_use_event


@dataclass(frozen=True)
class Branch:
    """A transition that may be taken; `message_key` holds the message that triggered it."""

    transition: Transition
    message_key: str | None = None

    @property
    def taken(self) -> Branch:
        """The same when nothing is left of it but its effects and where it leads."""
        key = self.message_key if effects_use_event(self.transition.effects) else None
        return Branch(replace(self.transition, triggers=(), guard=None), key)

    @property
    def without_effects(self) -> Branch:
        """The same for a place where it is decided and not done."""
        return Branch(replace(self.transition, effects=()))


@dataclass(frozen=True)
class Leave:
    """An outcome that leads to a state outside, for a transition that is taken already.

    Its effects are done when all that it leaves has ended.
    """

    branch: Branch


Route = list[Branch] | Leave
"""What comes after an outcome: the first branch whose guard holds. None of them: it stays."""


@dataclass(frozen=True)
class Content:
    """A SMACH state and where its outcomes lead."""

    call: Call
    routes: Mapping[str, Route]

    @property
    def may_stay(self) -> bool:
        """Whether it can end without leading to another state."""
        return any(stays(route) for route in self.routes.values())

    @property
    def is_guarded(self) -> bool:
        """Whether it has to be decided where some of its outcomes lead."""
        routes = [route for route in self.routes.values() if not isinstance(route, Leave)]
        return any(branch.transition.guard is not None for route in routes for branch in route)


def stays(route: Route) -> bool:
    """Whether it can be that it leads to no other state."""
    if isinstance(route, Leave):
        return False
    return not is_total(route) or any(branch.transition.target is None for branch in route)


def is_total(branches: Sequence[Branch]) -> bool:
    """Whether one of them is taken whatever the guards say."""
    return any(branch.transition.guard is None for branch in branches)


def reachable(transitions: Iterable[Transition]) -> list[Transition]:
    """Those before and with the first that has no guard."""
    found: list[Transition] = []
    for transition in transitions:
        found.append(transition)
        if transition.guard is None:
            break
    return found


def branches(state: State, matches: Callable[[Trigger], bool]) -> list[Branch]:
    """The transitions of a state with such a trigger."""
    found = [t for t in state.transitions if any(map(matches, t.triggers))]
    return [Branch(transition) for transition in reachable(found)]


def done(state: str, final: str | None) -> Callable[[Trigger], bool]:
    """Whether a trigger waits for this completion."""
    return lambda trigger: (
        isinstance(trigger, DoneTrigger)
        and trigger.state == state
        and (trigger.final is None or trigger.final == final)
    )


def ended(state: State, outcome: str) -> Callable[[Trigger], bool]:
    """Whether a trigger waits for this end of the state's activity."""
    model_outcome = PREEMPTED if outcome == CANCELLED else outcome
    return lambda trigger: (
        isinstance(trigger, OutcomeTrigger)
        and trigger.state == state.id
        and trigger.outcome == model_outcome
    )
