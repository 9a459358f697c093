"""By which outcomes transitions lead on in a library, and which states end with each of them.

What a transition leaves is left from the inside: the innermost states end with an outcome that
the machines around them pass on, up to the one that binds it to what comes next. So an outcome
has one meaning in all states that it passes, and is no name of a state in them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from swarmdsl.codegen import Diagnostics, dataclass, fresh
from swarmdsl.codegen.shared import delays
from swarmdsl.ir import (
    DoneTrigger,
    EventTrigger,
    OutcomeTrigger,
    State,
    StateKind,
    StateMachine,
    TimeTrigger,
    Trigger,
)

from .domains import Domains, Move, is_in
from .library import Library
from .reach import Reach

_LEAVES = (StateKind.SIMPLE, StateKind.CHOICE, StateKind.FINAL)


class Meaning(NamedTuple):
    """Where an outcome leads: in the container `domain`, to the state `label`."""

    domain: str
    label: str


@dataclass(frozen=True)
class Way:
    """A transition in the library: what is active inside `left` ends with an outcome.

    Which one that is depends on the event; one that needs no event has an empty name.
    `history` is the id of the history that it leads to, where the library has a state for that.
    """

    outcomes: tuple[tuple[str, str], ...]
    left: str
    history: str = ""


class Ways:
    """The ways of a machine, and the outcomes of its states with what they mean."""

    def __init__(self, machine: StateMachine, library: Library, report: Diagnostics) -> None:
        self.domains = Domains(machine)
        self.reach = Reach(machine, self.domains)
        self.outcomes: dict[str, dict[str, Meaning]] = {}
        self.of: dict[str, tuple[Way | None, ...]] = {}
        self._machine = machine
        self._library = library
        self._known = {state.id: state for state in machine.walk()}
        self._report = report
        self._known_inside: dict[str, tuple[str, ...]] = {}
        # Of what is directly in each state that has others in it.
        self._names: dict[str, set[str]] = {}
        for state in machine.walk():
            self.outcomes[state.id] = {}
            if state.states:
                names = {self.junction(state.id), *(child.name for child in state.states)}
                self._names[state.id] = names
        for state in machine.walk():
            moves = self.domains.moves(state) if state.id in self.reach.states else []
            found = self._named(moves)
            if any(found):
                self.of[state.id] = found

    def junction(self, around: str) -> str:
        """The name of the state that leads to the first one in a container; empty without one."""
        if len(self.reach.firsts.get(around, ())) < 2:
            return ""
        return fresh("Entry", (child.name for child in self._children(around)))

    def _children(self, around: str) -> tuple[State, ...]:
        return self._known[around].states if around else self._machine.states

    # ---- names

    def _named(self, moves: list[Move | None]) -> tuple[Way | None, ...]:
        """The way of each transition of a state."""
        labels: dict[str, set[str]] = {}
        for move in moves:
            for trigger, _ in move.triggers if move is not None else ():
                assert move is not None
                labels.setdefault(_word(trigger, move), set()).add(move.label)
        return tuple(self._way(move, labels) if move is not None else None for move in moves)

    def _way(self, move: Move, labels: Mapping[str, set[str]]) -> Way | None:
        self._check(move)
        outcomes = []
        for trigger, event in move.triggers:
            word = _word(trigger, move)
            name = word if len(labels[word]) == 1 else f"{word}_{move.label}"
            if passed := self._passed(trigger, move):
                outcomes.append((event, self._outcome(name, move, passed)))
        if not outcomes:
            return None
        left = move.domain if move.inner else _child(move.domain, move.state.id)
        is_history = move.target in self.reach.histories and _around(move.target) == move.domain
        return Way(tuple(outcomes), left, move.target if is_history else "")

    def _outcome(self, name: str, move: Move, passed: set[str]) -> str:
        """The outcome by which a transition leads on, through the states with these ids."""
        meaning = Meaning(move.domain, move.label)
        taken = {
            each
            for state in passed
            for each, known in self.outcomes[state].items()
            if known != meaning
        }
        taken.add(self._library.stopped)
        taken.update(*(self._names[state] for state in self._names.keys() & passed))
        outcome = name if name not in taken else fresh(f"{move.state.name}_{name}", taken)
        for state in passed:
            self.outcomes[state][outcome] = meaning
        return outcome

    def _check(self, move: Move) -> None:
        """Report a history that may lead less far than the transition to it."""
        target = self._known[move.target]
        if target.kind is not StateKind.HISTORY or move.inner:
            return
        default = target.transitions[0].target or ""
        child = _child(move.domain, move.state.id)
        is_deep = target.deep or is_in(default, child)
        if _around(move.target) == move.domain and is_deep and child != move.state.id:
            self._report.report(
                "unsupported-construct",
                move.origin,
                target=self._library.target,
                construct="a transition to a deep history from states inside of others around it",
                help=f"let state `{child}` have the transition",
            )

    # ---- what is left

    def _passed(self, trigger: Trigger | None, move: Move) -> set[str]:
        """The ids of the states that end with a transition."""
        found: set[str] = set()
        for state in self._left(trigger, move):
            if inside := self._inside(state):
                around = [each.id for each in self.domains.ancestors(state)]
                found.update(around[: around.index(move.domain)], inside)
        return found

    def _left(self, trigger: Trigger | None, move: Move) -> Iterator[State]:
        """The states that can be active when a transition leaves what is around them.

        With each goes all that is in it.
        """
        if isinstance(trigger, DoneTrigger):
            owner = self._known[trigger.state]
            if owner.id == move.domain or is_in(owner.id, move.domain):
                if completed := self._completed(owner, trigger.final):
                    yield from completed
                    yield from self._beside(owner, move.domain)
                return
        yield from self.reach.inside(move.state) if move.inner else (move.state,)
        yield from self._beside(move.state, move.domain)

    def _beside(self, state: State, domain: str) -> Iterator[State]:
        """Those in other regions of the parallel states around one, up to the domain."""
        if state.id == domain:
            return
        inner = state
        for around in self.domains.ancestors(state):
            if around.id == domain:
                return
            if around.kind is StateKind.PARALLEL:
                yield from (each for each in self.reach.inside(around) if each is not inner)
            inner = around

    def _inside(self, state: State) -> tuple[str, ...]:
        """The ids of a state and of those in it; none where it has no innermost states."""
        if state.id not in self._known_inside:
            inner = [each for child in self.reach.inside(state) for each in self._inside(child)]
            is_left = inner or state.kind in _LEAVES
            self._known_inside[state.id] = (state.id, *inner) if is_left else ()
        return self._known_inside[state.id]

    def _completed(self, state: State, final: str | None) -> list[State]:
        """The final states in which a state is complete, none where it never is."""
        if state.kind is not StateKind.PARALLEL:
            finals = [each for each in self.reach.inside(state) if each.kind is StateKind.FINAL]
            return [each for each in finals if final in (None, each.id)]
        regions = [self._completed(region, None) for region in self.reach.inside(state)]
        return [each for region in regions for each in region] if all(regions) else []


def _around(state: str) -> str:
    return state.rpartition(".")[0]


def _child(domain: str, state: str) -> str:
    """The id of the child of a container that a state is or is in."""
    name = (state[len(domain) + 1 :] if domain else state).partition(".")[0]
    return f"{domain}.{name}" if domain else name


def _word(trigger: Trigger | None, move: Move) -> str:
    """What an outcome is called if nothing else is: after what triggers the transition."""
    match trigger:
        case EventTrigger(event=event):
            return event
        case OutcomeTrigger(outcome=outcome):
            return outcome
        case DoneTrigger(final=final):
            return final.rpartition(".")[2] if final is not None else "done"
        case TimeTrigger(delay=delay):
            number = delays(move.owner).index(delay)
            return f"timeout_{number + 1}" if number else "timeout"
    return move.label
