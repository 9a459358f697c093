"""Outcomes of the states of a machine in a library that follows the engine.

A transition leaves states from the inside out: the innermost states end with an outcome that the
machines around them pass on, up to the container that binds it to the next state. So an outcome
has one target in all states that it passes, and is not the name of a state in them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from swarmdsl.codegen import Diagnostics, dataclass, fresh
from swarmdsl.ir import DoneTrigger, State, StateKind, StateMachine, Trigger

from ..outcome_routes import OutcomeRoute, Target, TransitionDomains, is_inside, outcome_word
from .library import Library
from .reach import Reach

_LEAVES = (StateKind.SIMPLE, StateKind.CHOICE, StateKind.FINAL)


@dataclass(frozen=True)
class OutcomeTransition:
    """A transition in the library: the active states inside `left` end with an outcome.

    `outcomes` are pairs of an event, empty where none is needed, and its outcome. `history` is the
    id of the history state that it leads to, where the library has a state for it.
    """

    outcomes: tuple[tuple[str, str], ...]
    left: str
    history: str = ""


class OutcomeTable:
    """The outcomes of each state of a machine, and its transitions.

    `outcomes` has the target of each outcome by the id of a state, `transitions` an entry for each
    transition of a state, None for one that leaves no state.
    """

    def __init__(self, machine: StateMachine, library: Library, report: Diagnostics) -> None:
        self.domains = TransitionDomains(machine)
        self.reach = Reach(machine, self.domains)
        self.outcomes: dict[str, dict[str, Target]] = {}
        self.transitions: dict[str, tuple[OutcomeTransition | None, ...]] = {}
        self._machine = machine
        self._library = library
        self._known = {state.id: state for state in machine.walk()}
        self._report = report
        self._known_inside: dict[str, tuple[str, ...]] = {}
        self._known_finals: dict[str, list[State]] = {}
        # By the id of a state: the names of the states directly inside.
        self._names: dict[str, set[str]] = {}
        for state in machine.walk():
            self.outcomes[state.id] = {}
            if state.states:
                names = {self.junction(state.id), *(child.name for child in state.states)}
                self._names[state.id] = names
        for state in machine.walk():
            routes = self.domains.routes(state) if state.id in self.reach.states else []
            found = self._transitions(routes)
            if any(found):
                self.transitions[state.id] = found

    def junction(self, around: str) -> str:
        """Return the name of the junction in which a container begins, empty if none is needed."""
        if len(self.reach.firsts.get(around, ())) < 2:
            return ""
        return fresh("Entry", (child.name for child in self._children(around)))

    def _children(self, around: str) -> tuple[State, ...]:
        return self._known[around].states if around else self._machine.states

    # ---- names

    def _transitions(self, routes: list[OutcomeRoute]) -> tuple[OutcomeTransition | None, ...]:
        """Return the transition of each route of a state."""
        labels: dict[str, set[str]] = {}
        for route in routes:
            if route.target is not None:
                for trigger, _ in route.triggers:
                    labels.setdefault(outcome_word(trigger, route), set()).add(route.target.label)
        return tuple(
            self._transition(route, route.target, labels) if route.target is not None else None
            for route in routes
        )

    def _transition(
        self, route: OutcomeRoute, target: Target, labels: Mapping[str, set[str]]
    ) -> OutcomeTransition | None:
        self._check(route, target)
        outcomes = []
        for trigger, event in route.triggers:
            word = outcome_word(trigger, route)
            name = word if len(labels[word]) == 1 else f"{word}_{target.label}"
            if passed := self._passed(trigger, route, target.container):
                outcomes.append((event, self._outcome(name, route.state, target, passed)))
        if not outcomes:
            return None
        container, entered = target.container, target.state
        left = container if route.internal else _child(container, route.state.id)
        is_history = entered in self.reach.histories and _around(entered) == container
        return OutcomeTransition(tuple(outcomes), left, entered if is_history else "")

    def _outcome(self, name: str, source: State, target: Target, passed: set[str]) -> str:
        """Return the outcome of a transition for the states with the ids `passed`."""
        target = Target(target.container, target.label)

        def is_taken(outcome: str) -> bool:
            known = (self.outcomes[state].get(outcome, target) for state in passed)
            return (
                outcome == self._library.stopped
                or any(each != target for each in known)
                or any(outcome in self._names.get(state, ()) for state in passed)
            )

        outcome, number = name, 1
        while is_taken(outcome):
            outcome = f"{source.name}_{name}" + (f"_{number}" if number > 1 else "")
            number += 1
        for state in passed:
            self.outcomes[state][outcome] = target
        return outcome

    def _check(self, route: OutcomeRoute, target: Target) -> None:
        """Report a history whose default transition may leave fewer states than the route to it."""
        history = self._known[target.state]
        if history.kind is not StateKind.HISTORY or route.internal:
            return
        default = history.transitions[0].target or ""
        child = _child(target.container, route.state.id)
        is_deep = history.deep or is_inside(default, child)
        if _around(history.id) == target.container and is_deep and child != route.state.id:
            self._report.report(
                "unsupported-construct",
                route.transition.origin,
                target=self._library.target,
                construct="a transition to a deep history from a nested state",
                help=f"move the transition to state `{child}`",
            )

    # ---- states that end

    def _passed(self, trigger: Trigger | None, route: OutcomeRoute, domain: str) -> set[str]:
        """Return the ids of the states that end with a transition."""
        found: set[str] = set()
        for state in self._left(trigger, route, domain):
            if inside := self._inside(state):
                around = [each.id for each in self.domains.ancestors(state)]
                found.update(around[: around.index(domain)], inside)
        return found

    def _left(self, trigger: Trigger | None, route: OutcomeRoute, domain: str) -> Iterator[State]:
        """Yield the states that can be active when a transition leaves them.

        The states inside them end as well.
        """
        if isinstance(trigger, DoneTrigger):
            owner = self._known[trigger.state]
            if owner.id == domain or is_inside(owner.id, domain):
                if completed := self._completed(owner, trigger.final):
                    yield from completed
                    yield from self._beside(owner, domain)
                return
        yield from self.reach.inside(route.state) if route.internal else (route.state,)
        yield from self._beside(route.state, domain)

    def _beside(self, state: State, domain: str) -> Iterator[State]:
        """Yield the other regions of the parallel states around a state, up to the domain."""
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
        """Return the ids of a state and all inside; empty where it has no innermost states."""
        if state.id not in self._known_inside:
            inner = [each for child in self.reach.inside(state) for each in self._inside(child)]
            is_left = inner or state.kind in _LEAVES
            self._known_inside[state.id] = (state.id, *inner) if is_left else ()
        return self._known_inside[state.id]

    def _completed(self, state: State, final: str | None) -> list[State]:
        """Return the final states in which a state is complete; empty where it never is."""
        if final is not None and state.kind is not StateKind.PARALLEL:
            return [self._known[final]] if final in self.reach.states else []
        if state.id not in self._known_finals:
            inside = list(self.reach.inside(state))
            finals = [each for each in inside if each.kind is StateKind.FINAL]
            if state.kind is StateKind.PARALLEL:
                regions = [self._completed(region, None) for region in inside]
                finals = [each for region in regions for each in region] if all(regions) else []
            self._known_finals[state.id] = finals
        return self._known_finals[state.id]


def _around(state: str) -> str:
    return state.rpartition(".")[0]


def _child(domain: str, state: str) -> str:
    """Return the id of the child of a container that is the state, or has it inside."""
    name = (state[len(domain) + 1 :] if domain else state).partition(".")[0]
    return f"{domain}.{name}" if domain else name
