"""How far a transition leads: what it leaves, and what it enters there."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.codegen import Span, dataclass
from swarmdsl.codegen.shared import Events, entered_region, region_transitions
from swarmdsl.ir import State, StateKind, StateMachine, Transition, Trigger


@dataclass(frozen=True)
class Move:
    """A transition of a state that leads somewhere.

    `triggers` has what each trigger means, with the name of the event in the chart; None with no
    name where it needs none. `domain` is the id of the innermost state around that is not left,
    `""` for the machine, `target` the id of what is entered in it. An `inner` one is of the
    domain itself. The triggers are those of the state `owner`.
    """

    state: State
    triggers: tuple[tuple[Trigger | None, str], ...]
    domain: str
    target: str
    inner: bool
    owner: State
    origin: Span | None

    @property
    def label(self) -> str:
        """The name of the state in the domain that is entered, or in which the target is."""
        return self.target[len(self.domain) :].lstrip(".").partition(".")[0]


class Domains:
    """Finds the moves of a machine."""

    def __init__(self, machine: StateMachine) -> None:
        self._root = State("", "", StateKind.COMPOSITE, states=machine.states)
        self._around = {state.id: self._root for state in machine.states}
        for state in machine.walk():
            self._around.update((child.id, state) for child in state.states)
        self._events = Events(machine, {state.id: state.id for state in machine.walk()})

    def around(self, state: State) -> State:
        """The state that one is in; the machine counts as one."""
        return self._around[state.id]

    def ancestors(self, state: State) -> Iterator[State]:
        """The states around one, from the inside, and the machine."""
        while state is not self._root:
            state = self._around[state.id]
            yield state

    def moves(self, state: State) -> list[Move | None]:
        """One for each transition in the table of the machine, None for one that leads nowhere.

        After those of a region stand those of the parallel state around that it takes.
        """
        if state.kind is StateKind.HISTORY:
            return []
        found = [self._move(each, state) for each in state.transitions]
        around = self.around(state)
        if around.kind is StateKind.PARALLEL:
            for event, _, transition, _ in region_transitions(state, around, self._events):
                assert transition.target is not None
                heard = [each for each in self._triggers(transition, around) if each[1] == event]
                target, origin = transition.target, transition.origin
                found.append(Move(state, tuple(heard), state.id, target, True, around, origin))
        return found

    def _triggers(
        self, transition: Transition, owner: State
    ) -> tuple[tuple[Trigger | None, str], ...]:
        triggers = ((t, self._events.of_trigger(t, owner)) for t in transition.triggers)
        return tuple((t, event) for t, events in triggers for event in events) or ((None, ""),)

    def _move(self, transition: Transition, state: State) -> Move | None:
        """The domain by SCXML 1.0, Appendix D, getTransitionDomain."""
        target = transition.target
        if target is None or entered_region(transition, state) is not None:
            return None
        inside = transition.internal and state.kind is not StateKind.PARALLEL
        candidates = [state] if inside else []
        candidates += self.ancestors(state)
        domain = next(
            each.id
            for each in candidates
            if each.kind is not StateKind.PARALLEL and is_in(target, each.id)
        )
        triggers = self._triggers(transition, state)
        inner = domain == state.id
        return Move(state, triggers, domain, target, inner, state, transition.origin)


def is_in(state: str, around: str) -> bool:
    """Whether a state is inside another one, by their ids."""
    return not around or state.startswith(f"{around}.")
