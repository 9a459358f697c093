"""Which states a machine can come to, and which of them are entered first in those around.

A library may refuse a state that nothing leads to, and a machine in it begins in a fixed one.
"""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.ir import State, StateKind, StateMachine

from .domains import Domains

_CONTAINERS = (StateKind.COMPOSITE, StateKind.REGION)


class Reach:
    """What can be reached in a machine, as far as transitions say; guards are not looked at.

    `states` has ids, `firsts` by the id of a container, "" for the machine, the names of the
    states in it that can be the first, `histories` the ids of those that something inside of
    the state around leads to.
    """

    def __init__(self, machine: StateMachine, domains: Domains) -> None:
        self.states: set[str] = set()
        self.firsts: dict[str, set[str]] = {}
        self.histories: set[str] = set()
        self._known = {state.id: state for state in machine.walk()}
        self._waiting: list[str] = []
        self._restored: set[str] = set()
        self._enter("", machine.initial, is_first=True)
        while self._waiting:
            state = self._known[self._waiting.pop()]
            for move in domains.moves(state):
                if move is not None:
                    self._enter(move.domain, move.target)
            if not self._waiting:
                for around in sorted(self._restored):
                    self._restore(self._known[around])

    def inside(self, state: State | StateMachine) -> Iterator[State]:
        """The states inside that can be reached, without histories."""
        return (child for child in state.states if child.id in self.states)

    def _enter(self, domain: str, target: str, is_first: bool = False) -> None:
        """Enter a state and those around it up to one that is active already."""
        around = domain
        *path, name = (target[len(domain) + 1 :] if domain else target).split(".")
        for each in path:
            self._note(around, each, is_first or around != domain)
            around = f"{around}.{each}" if around else each
        state = self._known[target]
        if state.kind is StateKind.HISTORY:
            self._enter_history(state, around == domain)
        else:
            self._note(around, name, is_first or around != domain)
            self._enter_inside(state)

    def _note(self, around: str, name: str, is_first: bool) -> None:
        """Take note that a state is entered, with the other regions of a parallel one around."""
        state = f"{around}.{name}" if around else name
        if state not in self.states:
            self.states.add(state)
            self._waiting.append(state)
        if not is_first:
            return
        if not around or self._known[around].kind in _CONTAINERS:
            self.firsts.setdefault(around, set()).add(name)
        else:
            for region in self._known[around].states:
                if region.name != name:
                    self._enter_region(region)

    def _enter_inside(self, state: State) -> None:
        """Enter what is entered with a state if nothing else is said."""
        if state.initial is not None:
            self._enter(state.id, state.initial, is_first=True)
        elif state.kind is StateKind.PARALLEL:
            for region in state.states:
                self._enter_region(region)

    def _enter_region(self, region: State) -> None:
        self._note(region.id.rpartition(".")[0], region.name, is_first=False)
        self._enter_inside(region)

    def _enter_history(self, history: State, is_local: bool) -> None:
        around = history.id.rpartition(".")[0]
        if is_local:
            self.histories.add(history.id)
        else:
            self._restored.add(around)
        if history.deep:
            inside = (each for each in self._known[around].walk() if each.kind in _CONTAINERS)
            self._restored |= {each.id for each in inside if each.id != around}
        default = history.transitions[0].target
        assert default is not None
        self._enter(around, default, is_first=not is_local)

    def _restore(self, around: State) -> None:
        """Let any state that was reached be the first in the one around."""
        for child in self.inside(around):
            self._note(around.id, child.name, is_first=True)
            self._enter_inside(child)
