"""The events that triggers mean in a portable document.

Events that the machine itself makes begin with a keyword of the language, so they differ
from every event of the model:

    do.<state>.<outcome>     the activity of a state ended; its data are the result
    gives.<state>.succeeded  the same, once the result is stored
    after.<state>.<n>        the n-th delay of a state has passed
    final.<final state>      a final state was entered; comes before done.state.<state>
"""

from __future__ import annotations

from collections.abc import Mapping

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


class Events:
    """Names the events of a machine whose states have the XML ids `ids`."""

    def __init__(self, machine: StateMachine, ids: Mapping[str, str]) -> None:
        self.ids = ids
        self.states = {state.id: state for state in machine.walk()}
        # States of which some transition wants to know in which final state they are.
        self.told_apart = {
            trigger.state
            for state in self.states.values()
            for transition in state.transitions
            for trigger in transition.triggers
            if isinstance(trigger, DoneTrigger) and trigger.final is not None
        }

    def of_transition(self, transition: Transition, state: State) -> list[str]:
        """The events that trigger a transition; an empty one where it needs none."""
        triggers = transition.triggers
        return [each for trigger in triggers for each in self.of_trigger(trigger, state)] or [""]

    def of_trigger(self, trigger: Trigger, state: State) -> list[str]:
        """The events that a trigger of this state means."""
        match trigger:
            case EventTrigger(event=event):
                return [event]
            case OutcomeTrigger(outcome=outcome):
                if outcome == "aborted" and not _handles_preempted(state):
                    return [self.outcome(state, "aborted"), self.outcome(state, "preempted")]
                return [self.outcome(state, outcome)]
            case TimeTrigger(delay=delay):
                return [self.timer(state, delay)]
            case DoneTrigger(state=owner, final=final):
                return self._done(owner) if final is None else [self.final(final)]

    def outcome(self, state: State, outcome: str) -> str:
        """The event of how the activity of a state ended."""
        return f"do.{self.ids[state.id]}.{outcome}"

    def stored(self, state: State) -> str:
        """The event of an activity that succeeded and whose result is stored."""
        return f"gives.{self.ids[state.id]}.succeeded"

    def timer(self, state: State, delay: Expression) -> str:
        """The event of a delay that has passed."""
        return f"after.{self.ids[state.id]}.{delays(state).index(delay) + 1}"

    def final(self, final: str) -> str:
        """The event of a final state that was entered."""
        return f"final.{self.ids[final]}"

    def _done(self, owner: str) -> list[str]:
        if owner not in self.told_apart:
            return [f"done.state.{self.ids[owner]}"]
        # `done.state` would come second, when what the first event led to is over already.
        inside = self.states[owner].states
        return [self.final(each.id) for each in inside if each.kind is StateKind.FINAL]


def delays(state: State) -> list[Expression]:
    """The different delays of a state: transitions after the same time share a timer."""
    return list(
        dict.fromkeys(
            trigger.delay
            for transition in state.transitions
            for trigger in transition.triggers
            if isinstance(trigger, TimeTrigger)
        )
    )


def _handles_preempted(state: State) -> bool:
    """Whether a state tells an activity that gave up from one that failed."""
    given_up = OutcomeTrigger(state.id, "preempted")
    return any(given_up in transition.triggers for transition in state.transitions)
