"""Transitions as outcomes: by which triggers, out of which container, to which state.

Libraries such as SMACH and YASMIN have no transitions, but outcomes of states, which containers
bind to the next state. This module has what their targets share: the routes of a state and the
domain of each. The targets differ in how an outcome leaves containers, for a reason:

- On ROS 1, states in SMACH drive the machine. Each container on the route has an outcome of its
  own, `to_<label>`, which the container around it binds (`smach/outcomes.py`).
- On ROS 2, the states of SMACH or YASMIN follow the engine, and all regions of a parallel state
  end together. So one outcome has one target in all states that it passes
  (`ros2_outcomes/outcome_table.py`).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from swarmdsl.codegen import FreshNames, dataclass
from swarmdsl.codegen.shared import Events, delays, entered_region, region_transitions
from swarmdsl.ir import (
    DoneTrigger,
    EventTrigger,
    Expression,
    OutcomeTrigger,
    State,
    StateKind,
    StateMachine,
    TimeTrigger,
    Transition,
    Trigger,
)


class Target(NamedTuple):
    """The state `label` that is entered in a container, and the path `inside` it.

    `container` is the id of a state, `""` for the machine; `inside` is empty where the initial
    state is entered.
    """

    container: str
    label: str
    inside: str = ""

    @property
    def state(self) -> str:
        """The id of the state that is entered."""
        return ".".join(filter(None, self))


@dataclass(frozen=True)
class OutcomeRoute:
    """A transition of a state, as the state takes it.

    `triggers` are pairs of a trigger of the state `owner` and its event, `(None, "")` for a
    transition without triggers. `target` is None where the state is not left. A region also takes
    the internal transitions of the parallel state `owner` around it, which are `inherited`; in the
    parallel state they are `delegated` and do nothing. `timers` are the names of the delays of the
    owner.
    """

    state: State
    owner: State
    transition: Transition
    triggers: tuple[tuple[Trigger | None, str], ...]
    guard: Expression | None
    target: Target | None
    timers: Mapping[Expression, str]
    delegated: bool = False

    @property
    def inherited(self) -> bool:
        """True if the transition is one of the parallel state around."""
        return self.owner is not self.state

    @property
    def internal(self) -> bool:
        """True if the transition does not leave the state."""
        return self.target is not None and self.target.container == self.state.id


class TransitionDomains:
    """Transition domains and outcome routes of a machine."""

    def __init__(self, machine: StateMachine) -> None:
        self._root = State("", "", StateKind.COMPOSITE, states=machine.states)
        self._parents = {state.id: self._root for state in machine.states}
        for state in machine.walk():
            self._parents.update((child.id, state) for child in state.states)
        self.events = Events(machine, {state.id: state.id for state in machine.walk()})

    def parent(self, state: State) -> State:
        """Return the state around a state; the machine counts as one."""
        return self._parents[state.id]

    def ancestors(self, state: State) -> Iterator[State]:
        """Yield the states around a state from the inside out, the machine last."""
        while state is not self._root:
            state = self._parents[state.id]
            yield state

    def domain(self, transition: Transition, state: State) -> str:
        """Return the id of the innermost container that a transition does not leave.

        SCXML 1.0, Appendix D, getTransitionDomain.
        """
        assert transition.target is not None
        inside = transition.internal and state.kind is not StateKind.PARALLEL
        candidates = [*([state] if inside else []), *self.ancestors(state)]
        return next(
            each.id
            for each in candidates
            if each.kind is not StateKind.PARALLEL and is_inside(transition.target, each.id)
        )

    def routes(self, state: State) -> list[OutcomeRoute]:
        """Return the routes of a state in the order of its transitions, inherited ones last."""
        if state.kind is StateKind.HISTORY:
            return []
        found = []
        timers = timer_names(state)
        for each in state.transitions:
            delegated = entered_region(each, state) is not None
            target = None
            if each.target is not None and not delegated:
                target = target_in(self.domain(each, state), each.target)
            triggers = self._triggers(each, state)
            found.append(
                OutcomeRoute(state, state, each, triggers, each.guard, target, timers, delegated)
            )
        owner = self.parent(state)
        if owner.kind is StateKind.PARALLEL:
            timers = timer_names(owner)
            for event, guard, each, _ in region_transitions(state, owner, self.events):
                assert each.target is not None
                triggers = tuple(pair for pair in self._triggers(each, owner) if pair[1] == event)
                target = target_in(state.id, each.target)
                found.append(OutcomeRoute(state, owner, each, triggers, guard, target, timers))
        return found

    def _triggers(
        self, transition: Transition, owner: State
    ) -> tuple[tuple[Trigger | None, str], ...]:
        pairs = (
            (trigger, event)
            for trigger in transition.triggers
            for event in self.events.of_trigger(trigger, owner)
        )
        return tuple(pairs) or ((None, ""),)


def target_in(container: str, state: str) -> Target:
    """Return the target for a state inside a container, given the ids of both."""
    path = state[len(container) + 1 :] if container else state
    label, _, inside = path.partition(".")
    return Target(container, label, inside)


def is_inside(state: str, container: str) -> bool:
    """Return True if a state is inside another one, given the ids of both."""
    return not container or state.startswith(f"{container}.")


def timer_names(state: State) -> dict[Expression, str]:
    """Return names for the delays of a state: `timeout`, `timeout_2`, ..."""
    names = FreshNames()
    return {delay: names.new("timeout") for delay in delays(state)}


def outcome_word(trigger: Trigger | None, route: OutcomeRoute) -> str:
    """Return the first choice for the name of an outcome: the trigger, or else the target.

    The empty string for a transition without trigger and target.
    """
    match trigger:
        case EventTrigger(event=event):
            return event
        case OutcomeTrigger(outcome=outcome):
            return outcome
        case TimeTrigger(delay=delay):
            return route.timers[delay]
        case DoneTrigger(final=final):
            return final.rpartition(".")[2] if final is not None else "done"
    return route.target.label if route.target is not None else ""
