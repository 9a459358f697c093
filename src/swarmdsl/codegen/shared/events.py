"""Events of triggers in a portable document.

Events that the machine itself raises begin with a keyword of the language, so they differ
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
    """Names of the events of a machine whose states have the XML ids `ids`."""

    def __init__(self, machine: StateMachine, ids: Mapping[str, str]) -> None:
        self.ids = ids
        self.states = {state.id: state for state in machine.walk()}
        # States with a transition that depends on their final state.
        self.by_final_state: set[str] = set()
        # States that distinguish preempted from aborted activities.
        self._preempted: set[str] = set()
        for state in self.states.values():
            for transition in state.transitions:
                for trigger in transition.triggers:
                    if isinstance(trigger, DoneTrigger) and trigger.final is not None:
                        self.by_final_state.add(trigger.state)
                    elif trigger == OutcomeTrigger(state.id, "preempted"):
                        self._preempted.add(state.id)
        self._timers: dict[str, dict[Expression, str]] = {}

    def of_transition(self, transition: Transition, state: State) -> list[str]:
        """Return the events that trigger a transition; [""] if it needs none."""
        triggers = transition.triggers
        return [each for trigger in triggers for each in self.of_trigger(trigger, state)] or [""]

    def of_trigger(self, trigger: Trigger, state: State) -> list[str]:
        """Return the events that a trigger of this state stands for."""
        match trigger:
            case EventTrigger(event=event):
                return [event]
            case OutcomeTrigger(outcome=outcome):
                if outcome == "aborted" and state.id not in self._preempted:
                    return [self.outcome(state, "aborted"), self.outcome(state, "preempted")]
                return [self.outcome(state, outcome)]
            case TimeTrigger(delay=delay):
                return [self.timer(state, delay)]
            case DoneTrigger(state=owner, final=final):
                return self._done(owner) if final is None else [self.final(final)]

    def outcome(self, state: State, outcome: str) -> str:
        """Return the event for an outcome of a state's activity."""
        return f"do.{self.ids[state.id]}.{outcome}"

    def stored(self, state: State) -> str:
        """Return the event for an activity that succeeded and stored its result."""
        return f"gives.{self.ids[state.id]}.succeeded"

    def timer(self, state: State, delay: Expression) -> str:
        """Return the event for a delay that has passed."""
        if state.id not in self._timers:
            self._timers[state.id] = {
                each: f"after.{self.ids[state.id]}.{number}"
                for number, each in enumerate(delays(state), 1)
            }
        return self._timers[state.id][delay]

    def final(self, final: str) -> str:
        """Return the event for a final state that was entered."""
        return f"final.{self.ids[final]}"

    def _done(self, owner: str) -> list[str]:
        if owner not in self.by_final_state:
            return [f"done.state.{self.ids[owner]}"]
        # `done.state` would come second, after the transition on the first event.
        inside = self.states[owner].states
        return [self.final(each.id) for each in inside if each.kind is StateKind.FINAL]


def delays(state: State) -> list[Expression]:
    """Return the distinct delays of a state: equal ones share a timer."""
    return list(
        dict.fromkeys(
            trigger.delay
            for transition in state.transitions
            for trigger in transition.triggers
            if isinstance(trigger, TimeTrigger)
        )
    )
