"""Where transitions lead: by which outcome out of which container, to which label."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.codegen import dataclass, field, fresh
from swarmdsl.ir import State, StateKind, StateMachine, Transition

from .module import PREEMPTED, Entry


@dataclass(frozen=True)
class Way:
    """What a transition enters: in the container `domain`, the state `label` and `into` it.

    `domain` is the id of the innermost state around source and target that is not left, `""` for
    the machine; `into` is the path in the state, where it is not its initial state that is entered.
    """

    domain: str
    label: str
    into: str = ""


@dataclass
class Scope:
    """A container in the making; `owner` is the id of the state whose inside it is.

    `taken` are the labels in it and its own outcomes. `exits` are the outcomes of states inside
    that lead out of it, `internal` those of internal transitions of its owner, with the label.
    """

    owner: str
    taken: set[str]
    entries: list[Entry] = field(default_factory=list)
    exits: dict[str, Way] = field(default_factory=dict)
    internal: dict[str, str] = field(default_factory=dict)
    _known: dict[Way, str] = field(default_factory=dict)

    def bound(self, way: Way) -> str:
        """What a state in here is bound to: a label, or an outcome of the container."""
        if way.domain == self.owner:
            return way.label
        exit_ = Way(way.domain, way.label)
        if exit_ not in self._known:
            outcome = fresh(f"to_{way.label}", {*self.taken, *self.exits, PREEMPTED})
            self._known[exit_] = outcome
            self.exits[outcome] = exit_
        return self._known[exit_]


class Ways:
    """Finds the ways of the transitions of a machine."""

    def __init__(self, machine: StateMachine) -> None:
        self._root = State("", "", StateKind.COMPOSITE, states=machine.states)
        self._parents = {state.id: self._root for state in machine.states}
        for state in machine.walk():
            self._parents.update((child.id, state) for child in state.states)

    def around(self, state: State) -> State:
        """The state that one is in; the machine counts as one."""
        return self._parents[state.id]

    def of(self, transition: Transition, state: State) -> Way:
        """The way of a transition of that state, which has a target."""
        assert transition.target is not None
        inside = transition.internal and state.kind is not StateKind.PARALLEL
        around = [state] if inside else []
        around += self._ancestors(state)
        domain = next(
            each.id
            for each in around
            if each.kind is not StateKind.PARALLEL and _is_in(transition.target, each.id)
        )
        return way_into(domain, transition.target)

    def _ancestors(self, state: State) -> Iterator[State]:
        while state is not self._root:
            state = self._parents[state.id]
            yield state


def way_into(container: str, target: str) -> Way:
    """The way to a state inside a container, by the ids of both."""
    path = target[len(container) + 1 :] if container else target
    label, _, into = path.partition(".")
    return Way(container, label, into)


def named(bases: Iterable[tuple[str, Way | None]], taken: Iterable[str]) -> list[str | None]:
    """The outcome of each transition of a state, given what triggers it and its way.

    Those with one trigger that lead to one label share it; None for one that leads nowhere.
    """
    taken = [*taken]
    given = [(base, Way(way.domain, way.label) if way else None) for base, way in bases]
    targets: dict[str, dict[Way, None]] = {}
    for base, way in given:
        if way is not None:
            targets.setdefault(base, {}).setdefault(way)
    known: dict[tuple[str, Way], str] = {}
    found: list[str | None] = []
    for base, way in given:
        if way is None:
            found.append(None)
            continue
        if (base, way) not in known:
            name = base if len(targets[base]) == 1 else f"{base}_{way.label}"
            known[base, way] = fresh(name, {*known.values(), *taken, PREEMPTED})
        found.append(known[base, way])
    return found


def _is_in(state: str, around: str) -> bool:
    return not around or state.startswith(f"{around}.")
