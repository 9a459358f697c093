"""States and transitions of machines that occur in a swarm, and those that never do."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from swarmdsl import ir
from swarmdsl.base.source import Span
from swarmdsl.execution.engine import Machine
from swarmdsl.execution.verify.automata.labels import Moment
from swarmdsl.execution.verify.findings.finding import Finding


def transitions_of(machine: Machine) -> dict[str, ir.Transition]:
    """Return the transitions of the model by their names in traces."""
    found = {}
    for state in machine.states:
        for each in state.transitions:
            if isinstance(each.origin, ir.Transition) and (each.origin.triggers or each.guard):
                found[machine.called(each)] = each.origin
    return found


def place_of_change(machine: Machine, moment: Moment) -> Span | None:
    """Return the place of the first transition of a moment, else of the last state entered."""
    for name, transition in transitions_of(machine).items():
        if name in moment.taken:
            return transition.origin
    for name in moment.entered[-1:]:
        origin = machine.states[machine.numbers[name]].origin
        return origin.origin if isinstance(origin, ir.State) else None
    return None


class Reached:
    """States and transitions of a machine that occur in a swarm."""

    def __init__(self, machine: ir.StateMachine, table: Machine) -> None:
        self._machine = machine
        self._table = table
        self.roles: dict[str, None] = {}
        self.states: set[str] = set()
        self.taken: set[str] = set()
        self.sure = True

    def missing(self, ignored: Collection[str]) -> Iterator[Finding]:
        """Yield what never happens: states first, then transitions between states that occur.

        Transitions on `ignored` events have been reported with these.
        """
        if not self.sure:
            return
        role = " or ".join(self.roles)
        every = transitions_of(self._table)
        absent: set[str] = set()
        for state in self._machine.walk():
            is_place = state.kind not in (ir.StateKind.HISTORY, ir.StateKind.REGION)
            around = state.id.rpartition(".")[0]
            if state.id not in self.states and is_place:
                absent.add(state.id)
                if not any(around == a or around.startswith(f"{a}.") for a in absent):
                    yield Finding("unreachable", state.id, role, state.origin)
        for name, transition in every.items():
            source = name.rpartition("->")[0]
            if name in self.taken or source not in self.states or transition.target in absent:
                continue
            triggers = transition.triggers
            if triggers and all(_is_told(each, ignored) for each in triggers):
                continue
            yield Finding("untaken", transition.target or source, role, transition.origin)


def _is_told(trigger: ir.Trigger, ignored: Collection[str]) -> bool:
    """Return True for events that are told elsewhere, and for what only servers can cause."""
    match trigger:
        case ir.EventTrigger(event=event):
            return event in ignored
        case ir.OutcomeTrigger(outcome=outcome):
            return outcome == "preempted"
    return False
