"""Structure of a machine in the CPSwarm dialect: elements and transitions.

The dialect describes SMACH containers. A `<state>` with children is a state machine that ends
with an outcome of one of its states; a `<parallel>` ends as soon as one child does. So

- an event is awaited by a monitor beside the state: both are in `<Name>Threads`;
- a composite state with transitions is in such a `<parallel>` too, because a container
  with transitions of its own has no other outcomes (a `preempted` inside would have no way out);
- a transition that leaves a container, to its final state or further out, is left out: its
  outcome becomes the outcome of the container, and a transition on that continues.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import snake_case
from swarmdsl.base.records import dataclass, replace
from swarmdsl.base.source import Span
from swarmdsl.codegen.api import Feature
from swarmdsl.ir import (
    DoneTrigger,
    EventTrigger,
    OutcomeTrigger,
    State,
    StateKind,
    StateMachine,
    Transition,
)

OUTCOMES = ("succeeded", "aborted", "preempted")

TARGET = "scxml"


@dataclass(frozen=True)
class Monitor:
    """Wait for an event beside a state."""

    state: State
    event: str


@dataclass(frozen=True)
class Vertex:
    """A `<state>`, or a `<parallel>` of a state's activity and its monitors.

    `suffix` distinguishes the elements of one state (`Threads`, `Behavior`);
    `transitions` lead from an event of the dialect to a state of the machine.
    """

    state: State
    suffix: str = ""
    parallel: bool = False
    children: tuple[Vertex | Monitor, ...] = ()
    transitions: tuple[tuple[str, str], ...] = ()

    def walk(self) -> Iterator[Vertex]:
        """Yield the vertex and all inside it, in document order."""
        yield self
        for child in self.children:
            if isinstance(child, Vertex):
                yield from child.walk()


@dataclass(frozen=True)
class _Signal:
    """Outcome or event `name` that ends a vertex and leads to `target`."""

    name: str
    target: str
    origin: Span | None


def event_name(event: str) -> str:
    """Convert an event name: `MissionStart` becomes `missionStart`."""
    first, *others = snake_case(event).split("_")
    return first + "".join(word.capitalize() for word in others)


def shape(machine: StateMachine, report: Diagnostics) -> tuple[Vertex, ...]:
    """Return the elements of a machine; report what the dialect cannot express."""
    return _Shaper(machine, report).top()


class _Shaper:
    def __init__(self, machine: StateMachine, report: Diagnostics) -> None:
        self.machine = machine
        self.report = report
        self.states = {state.id: state for state in machine.walk()}
        self.awaited = {
            state.id: {monitor.event for monitor in _monitors(state)}
            for state in self.states.values()
        }
        self.parents: dict[str, str | None] = {state.id: None for state in machine.states}
        for state in self.states.values():
            self.parents.update((child.id, state.id) for child in state.states)

    def top(self) -> tuple[Vertex, ...]:
        children, _ = self._content(self.machine.states, self.machine.initial, self.machine.origin)
        return children

    def _content(
        self, states: Iterable[State], initial: str | None, origin: Span | None
    ) -> tuple[tuple[Vertex, ...], list[_Signal]]:
        """Return the content of a container, and the signals that end it."""
        inside = [state for state in states if state.kind is not StateKind.FINAL]
        if initial not in [state.id for state in inside]:
            self._reject(Feature.INTO_STATE.value, origin)
        # SMACH starts with the first state added.
        inside.sort(key=lambda state: state.id != initial)
        shaped = [self._vertex(state) for state in inside]
        return tuple(vertex for vertex, _ in shaped), [end for _, ends in shaped for end in ends]

    def _vertex(self, state: State) -> tuple[Vertex, list[_Signal]]:
        if state.kind is StateKind.PARALLEL:
            return self._parallel(state)
        if state.kind is StateKind.COMPOSITE:
            children, ends = self._content(state.states, state.initial, state.origin)
            ends = self._follow_final_states(ends, state.id, state.transitions)
        else:
            children, ends = (), []
            if state.activity is None and not _monitors(state):
                self._reject("a state that waits for nothing", state.origin)
        ends = self._deduplicate([*ends, *self._own_signals(state)])
        monitors = _monitors(state)
        staying = [end for end in ends if self._is_sibling(end, state)]
        if monitors or (children and staying):
            behavior: tuple[Vertex, ...] = ()
            if children:
                behavior = (Vertex(state, "Behavior", children=children),)
            elif state.activity is not None:
                behavior = (Vertex(state),)
            return self._parallel_vertex(
                Vertex(state, "Threads", True, (*behavior, *monitors)), ends
            )
        transitions = tuple((end.name, end.target) for end in staying)
        leaving = [end for end in ends if not self._is_sibling(end, state)]
        return Vertex(state, children=children, transitions=transitions), leaving

    def _parallel(self, state: State) -> tuple[Vertex, list[_Signal]]:
        children: list[Vertex | Monitor] = []
        ends: list[_Signal] = []
        for region in state.states:
            waiting = _only_awaits(region)
            if waiting is not None:
                children += _monitors(waiting)
                inner = self._own_signals(waiting)
            else:
                contents, inner = self._content(region.states, region.initial, region.origin)
                children.append(Vertex(region, children=contents))
            ends += self._follow_final_states(inner, region.id, state.transitions)
        for transition in state.transitions:
            for trigger in transition.triggers:
                if isinstance(trigger, DoneTrigger) and trigger.state == state.id:
                    self._reject("the end of all regions", trigger.origin or transition.origin)
        children += _monitors(state)
        ends = self._deduplicate([*ends, *self._own_signals(state)])
        return self._parallel_vertex(Vertex(state, "", True, tuple(children)), ends)

    def _parallel_vertex(self, vertex: Vertex, ends: list[_Signal]) -> tuple[Vertex, list[_Signal]]:
        """Return a parallel vertex with its transitions, and the signals that leave it."""
        staying = [end for end in ends if self._is_sibling(end, vertex.state)]
        leaving = [
            # A SMACH concurrence has its declared outcomes, and `aborted`.
            replace(end, name="aborted") if staying or end.name not in OUTCOMES else end
            for end in ends
            if not self._is_sibling(end, vertex.state)
        ]
        leaving = self._deduplicate(leaving)
        if any(end.name == "aborted" for end in staying):
            for end in leaving:
                self._reject("a second exit from a state that waits for an event", end.origin)
        transitions = tuple((end.name, end.target) for end in staying)
        return replace(vertex, transitions=transitions), leaving

    def _own_signals(self, state: State) -> list[_Signal]:
        """Return the signals of the state's own transitions; the first of a name counts."""
        around = self._containers(state.id)
        signals: dict[str, _Signal] = {}
        for transition in state.transitions:
            if transition.target is None:
                continue  # refused before: the dialect has no transition without a target
            if self.parents[transition.target] not in around:
                self._reject(Feature.INTO_STATE.value, transition.origin)
            for trigger in transition.triggers:
                origin = trigger.origin or transition.origin
                match trigger:
                    case EventTrigger(event=event):
                        name = event_name(event)
                        if any(self._awaits(outer, event) for outer in around):
                            self._reject("an event awaited on two levels", origin)
                    case OutcomeTrigger(outcome=outcome):
                        name = outcome
                    case _:
                        continue
                signals.setdefault(name, _Signal(name, transition.target, origin))
        return list(signals.values())

    def _awaits(self, state: str | None, event: str) -> bool:
        """Return True if an enclosing state waits for the event."""
        return state is not None and event in self.awaited[state]

    def _follow_final_states(
        self, ends: list[_Signal], container: str, transitions: tuple[Transition, ...]
    ) -> list[_Signal]:
        """Return the signals, with those to own final states led on to what follows."""
        followed = []
        following = _completion_targets(transitions)
        for end in ends:
            target: str | None = end.target
            final = self.states[end.target].kind is StateKind.FINAL
            if final and self.parents[end.target] == container:
                completions = (DoneTrigger(container, None), DoneTrigger(container, end.target))
                found = [following[each] for each in completions if each in following]
                target = min(found)[1] if found else None
            if target is None:
                self._reject("a final state that nothing follows", end.origin)
            else:
                followed.append(replace(end, target=target))
        return self._deduplicate(followed)

    def _deduplicate(self, signals: list[_Signal]) -> list[_Signal]:
        """Return the signals once each; report one with two targets."""
        known: dict[str, _Signal] = {}
        for signal in signals:
            first = known.setdefault(signal.name, signal)
            if first.target != signal.target:
                self._reject(f"`{signal.name}` leading to two places", signal.origin)
        return list(known.values())

    def _is_sibling(self, signal: _Signal, state: State) -> bool:
        target = self.states[signal.target]
        same = self.parents[target.id] == self.parents[state.id]
        return same and target.kind is not StateKind.FINAL

    def _containers(self, state: str) -> list[str | None]:
        """Return the containers around a state, None being the machine."""
        around: list[str | None] = []
        inner: str | None = state
        while inner is not None:
            inner = self.parents[inner]
            around.append(inner)
        return around

    def _reject(self, construct: str, origin: Span | None) -> None:
        self.report.report("unsupported-construct", origin, target=TARGET, construct=construct)


def _completion_targets(
    transitions: tuple[Transition, ...],
) -> dict[DoneTrigger, tuple[int, str | None]]:
    """Return the place and the target of the first transition on each end of a container."""
    found: dict[DoneTrigger, tuple[int, str | None]] = {}
    for number, transition in enumerate(transitions):
        for trigger in transition.triggers:
            if isinstance(trigger, DoneTrigger):
                found.setdefault(trigger, (number, transition.target))
    return found


def _monitors(state: State) -> tuple[Monitor, ...]:
    events = [
        trigger.event
        for transition in state.transitions
        for trigger in transition.triggers
        if isinstance(trigger, EventTrigger)
    ]
    return tuple(Monitor(state, event) for event in dict.fromkeys(events))


def _only_awaits(region: State) -> State | None:
    """Return the state of a region that only awaits events, for monitors to do."""
    inside = [state for state in region.states if state.kind is not StateKind.FINAL]
    if len(inside) != 1 or inside[0].kind is not StateKind.SIMPLE or inside[0].activity is not None:
        return None
    leaves = all(transition.target != inside[0].id for transition in inside[0].transitions)
    return inside[0] if leaves and inside[0].transitions else None
