"""Reachable states of a machine, and the first states of its containers.

A library may reject a state that nothing leads to, and a machine in it begins in a fixed state.
"""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.ir import State, StateKind, StateMachine

from ..outcome_routes import TransitionDomains

_CONTAINERS = (StateKind.COMPOSITE, StateKind.REGION)


class Reach:
    """Reachable states by the transitions of a machine, regardless of guards.

    `states` has ids. `firsts` has the names of the states that can be entered first in a container,
    by its id, `""` for the machine. `histories` has the ids of history states with a transition to
    them from inside the state around.
    """

    def __init__(self, machine: StateMachine, domains: TransitionDomains) -> None:
        self.states: set[str] = set()
        self.firsts: dict[str, set[str]] = {}
        self.histories: set[str] = set()
        self._known = {state.id: state for state in machine.walk()}
        self._waiting: list[str] = []
        self._restored: set[str] = set()
        self._enter("", machine.initial, is_first=True)
        while self._waiting:
            state = self._known[self._waiting.pop()]
            for route in domains.routes(state):
                if route.target is not None:
                    self._enter(route.target.container, route.target.state)
            if not self._waiting:
                for around in sorted(self._restored):
                    self._restore(self._known[around])

    def inside(self, state: State | StateMachine) -> Iterator[State]:
        """Return the reachable states directly inside, without history states."""
        return (child for child in state.states if child.id in self.states)

    def _enter(self, domain: str, target: str, is_first: bool = False) -> None:
        """Enter a state and the states around it, up to the domain, which is active already."""
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
        """Note that a state is entered, and enter the other regions if it is a region."""
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
        """Enter the initial state or the regions of a state."""
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
        """Note that each reached state inside can be the first."""
        for child in self.inside(around):
            self._note(around.id, child.name, is_first=True)
            self._enter_inside(child)
