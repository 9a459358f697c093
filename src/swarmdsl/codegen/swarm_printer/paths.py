"""Paths from a transition to its target, by the rules of the linker.

The first name of a path is looked up among the visible states, the nearest level first;
each further one inside the state before it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from swarmdsl.base.records import dataclass, replace
from swarmdsl.codegen.swarm_printer.layout import UnprintableError
from swarmdsl.ir import State, StateKind, StateMachine

# States by name; several of one name are in different regions.
Level = Mapping[str, Sequence[State]]


@dataclass(frozen=True)
class Place:
    """Position in a machine.

    `outer` are the visible states, the nearest first, `beside` those in all regions of the
    enclosing parallel states. `chains` lead to each state by id, from its outermost ancestor,
    without regions.
    """

    chains: Mapping[str, tuple[State, ...]]
    outer: tuple[Level, ...]
    beside: tuple[Level, ...] = ()

    def inside(self, state: State) -> Place:
        """Return the place of the states in a state or region."""
        if state.kind is StateKind.PARALLEL:
            return replace(self, beside=(level(state), *self.beside))
        return replace(self, outer=(level(state), *self.outer))

    def from_state(self, state: State) -> tuple[Level, ...]:
        """Return the scope of the transitions of a state."""
        return (*self.outer, level(state), *self.beside)

    def from_choice(self) -> tuple[Level, ...]:
        """Return the scope of the branches of a choice."""
        return (*self.outer, *self.beside)

    def path(self, target: str, levels: Iterable[Level]) -> str:
        """Return the shortest path to a state by its id."""
        chain = self.chains[target]
        for start in reversed(range(len(chain))):
            way = chain[start:]
            if _leads_there(way, levels):
                return ".".join(state.name for state in way)
        raise UnprintableError(f"another state hides `{target}` where a transition leads to it")


def top(machine: StateMachine) -> Place:
    """Return the place of the outermost states of a machine."""
    chains: dict[str, tuple[State, ...]] = {}
    _collect(machine.states, (), chains)
    return Place(chains, (_by_name(machine.states),))


def level(state: State) -> Level:
    """Yield the states inside another, through regions; reused machines are closed."""
    if state.submachine is not None:
        return {}
    if state.kind is StateKind.PARALLEL:
        return _by_name(inner for region in state.states for inner in region.states)
    return _by_name(state.states)


def _by_name(states: Iterable[State]) -> Level:
    found: dict[str, list[State]] = {}
    for state in states:
        found.setdefault(state.name, []).append(state)
    return found


def _leads_there(way: tuple[State, ...], levels: Iterable[Level]) -> bool:
    for state in way:
        found = next((each[state.name] for each in levels if state.name in each), ())
        if len(found) != 1 or found[0] is not state:
            return False
        levels = (level(state),)
    return True


def _collect(
    states: Iterable[State], around: tuple[State, ...], chains: dict[str, tuple[State, ...]]
) -> None:
    for state in states:
        chain = around if state.kind is StateKind.REGION else (*around, state)
        chains[state.id] = chain
        _collect(state.states, chain, chains)
