"""Which SMACH container a state stands in, and how a transition gets to its target from there."""

from __future__ import annotations

from dataclasses import dataclass, field

from swarmdsl.ir import State, StateKind

from .module import PREEMPTED, Entry, Module, fresh


@dataclass
class Scope:
    """A StateMachine in the making; `owner` is the id of the state whose inside it is.

    `finals` are the final states reached in it, `exits` the targets outside by outcome.
    """

    owner: str
    labels: set[str] = field(default_factory=set)
    entries: list[Entry] = field(default_factory=list)
    finals: dict[str, State] = field(default_factory=dict)
    exits: dict[str, str] = field(default_factory=dict)

    @property
    def outcomes(self) -> list[str]:
        """The outcomes of the container."""
        return [*self.finals, *self.exits, PREEMPTED]

    def label(self, name: str) -> str:
        """Take a label, unlike those there are."""
        found = fresh(name, {*self.labels, *self.exits})
        self.labels.add(found)
        return found


class Targets:
    """The states of a machine by id, and the state each one is in (`""` for the machine)."""

    def __init__(self, module: Module) -> None:
        self._module = module
        self.states = {state.id: state for state in module.machine.walk()}
        self.parent = {state.id: "" for state in module.machine.states}
        for state in module.machine.walk():
            self.parent.update((child.id, state.id) for child in state.states)

    def bind(self, scope: Scope, target: str | None) -> str:
        """What a state in this scope is bound to so that `target` comes next.

        That is a label, or an outcome of the scope's container.
        """
        assert target is not None  # one without a target is not supported
        state = self.states[target]
        if self.parent[target] == scope.owner:
            if state.kind is StateKind.FINAL:
                scope.finals.setdefault(state.name, state)
            return state.name
        for outcome, known in scope.exits.items():
            if known == target:
                return outcome
        names = {*scope.labels, *scope.exits}
        outcome = fresh(f"to_{target}", names)
        scope.exits[outcome] = target
        return outcome
