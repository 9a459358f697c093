"""Which SMACH container a state stands in, and how a transition gets to its target from there."""

from __future__ import annotations

from swarmdsl.dataclass import dataclass, field
from swarmdsl.ir import State, StateKind

from .module import PREEMPTED, Entry, Module, fresh
from .routes import Branch, Leave


@dataclass
class Scope:
    """A StateMachine in the making; `owner` is the id of the state whose inside it is.

    `finals` are the final states reached in it, `exits` the ways out of it by outcome.
    """

    owner: str
    labels: set[str] = field(default_factory=set)
    entries: list[Entry] = field(default_factory=list)
    finals: dict[str, State] = field(default_factory=dict)
    exits: dict[str, Leave] = field(default_factory=dict)

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
        self.states = {state.id: state for state in module.machine.walk()}
        self.parent = {state.id: "" for state in module.machine.states}
        for state in module.machine.walk():
            self.parent.update((child.id, state.id) for child in state.states)

    def region(self, state: State) -> str:
        """The region that a state is in, the innermost; `""` where it is in none."""
        around = self.parent[state.id]
        while around and self.states[around].kind is not StateKind.REGION:
            around = self.parent[around]
        return around

    def is_inside(self, scope: Scope, branch: Branch) -> bool:
        """Whether the target is in this very scope; effects of what leaves it come later."""
        target = branch.transition.target
        return target is None or self.parent[target] == scope.owner

    def bind(self, scope: Scope, branch: Branch) -> str:
        """What a state in this scope is bound to so that the target of `branch` comes next.

        That is a label, or an outcome of the scope's container.
        """
        target = branch.transition.target
        assert target is not None
        state = self.states[target]
        if self.is_inside(scope, branch):
            if state.kind is StateKind.FINAL:
                scope.finals.setdefault(state.name, state)
            return state.name
        way = Leave(branch.taken)
        for outcome, known in scope.exits.items():
            if known == way:
                return outcome
        outcome = fresh(f"to_{target}", {*scope.labels, *scope.exits})
        scope.exits[outcome] = way
        return outcome
