"""Paths from a transition to its target, by the rules of the linker.

The first name of a path is looked up among the visible states, the nearest level first;
each further one inside the state before it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, TypeVar, cast

from swarmdsl.base.records import dataclass, fields_of, replace
from swarmdsl.base.source import Span
from swarmdsl.codegen.swarm_printer.layout import UnprintableError
from swarmdsl.ir import Elapsed, InState, State, StateKind, StateMachine

# States by name; several of one name are in different regions.
Level = Mapping[str, Sequence[State]]


@dataclass(frozen=True)
class Place:
    """Position in a machine.

    `outer` are the visible states, the nearest first, `beside` those in all regions of the
    enclosing parallel states. `chains` lead to each state by id, from its outermost ancestor,
    without regions. `tests_states` is True if an expression of the machine tests a state.
    """

    chains: Mapping[str, tuple[State, ...]]
    outer: tuple[Level, ...]
    beside: tuple[Level, ...] = ()
    tests_states: bool = False

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
        raise UnprintableError(f"another state hides `{target}` where it is named")


def top(machine: StateMachine) -> Place:
    """Return the place of the outermost states of a machine."""
    chains: dict[str, tuple[State, ...]] = {}
    _collect(machine.states, (), chains)
    return Place(chains, (_by_name(machine.states),), tests_states=_tests_states(machine.states))


def level(state: State) -> Level:
    """Yield the states inside another, through regions; reused machines are closed."""
    if state.submachine is not None:
        return {}
    if state.kind is StateKind.PARALLEL:
        return _by_name(inner for region in state.states for inner in region.states)
    return _by_name(state.states)


T = TypeVar("T")


def with_tested_paths(state: State, place: Place) -> State:
    """Return a state in whose expressions each state is its path from there.

    The innermost state of a time is left out.
    """
    if not place.tests_states:
        return state
    levels = place.from_choice() if state.kind is StateKind.CHOICE else place.from_state(state)
    own = {name: getattr(state, name) for name in ("transitions", "activity", "entry", "exit")}
    inmost = state.id.rpartition(".")[0] if state.kind is StateKind.CHOICE else state.id
    changed = {name: _with_paths(value, place, levels, inmost) for name, value in own.items()}
    return replace(state, **cast("Any", changed))


def _with_paths(node: T, place: Place, levels: tuple[Level, ...], inmost: str) -> T:
    if isinstance(node, InState):
        return cast("T", replace(node, state=place.path(node.state, levels)))
    if isinstance(node, Elapsed):
        path = "" if node.state == inmost else place.path(node.state, levels)
        return cast("T", replace(node, state=path))
    if isinstance(node, tuple) and not isinstance(node, Span):
        return cast("T", tuple(_with_paths(each, place, levels, inmost) for each in node))
    if "__parts__" not in vars(type(node)):
        return node
    names = fields_of(type(node))
    changed = {name: _with_paths(getattr(node, name), place, levels, inmost) for name in names}
    return cast("T", replace(cast("Any", node), **changed))


def _tests_states(node: object) -> bool:
    """Return True if an expression in a node of the IR tests a state or measures its time."""
    if isinstance(node, (InState, Elapsed)):
        return True
    if isinstance(node, tuple) and not isinstance(node, Span):
        return any(map(_tests_states, node))
    if "__parts__" not in vars(type(node)):
        return False
    return any(_tests_states(getattr(node, name)) for name in fields_of(type(node)))


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
