"""Compute microsteps: SCXML 1.0, Appendix D, on sets of states."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Callable, NamedTuple, Protocol  # noqa: UP035 - for Python 3.8

from .table import Edge, Event, InstanceLike, Kind, Machine, State, Transition, members
from .world import FAILURES


class Executor(InstanceLike, Protocol):
    """An instance, for the operations of a microstep."""

    def note_entry(self, state: str) -> None:
        """Note the time at which a timed state is entered."""

    def stop_activity(self, state: int) -> None:
        """Cancel the activity of an exited state."""


Operation = Callable[[Executor, Event], object]


class Microstep(NamedTuple):
    """Result of taking transitions, as plain data.

    `active` and `histories` describe the configuration after it. `operations` are executed in
    order, each with the states that are active at that moment. `starts` are the entered states
    that have an activity, `final` is the entered final state of the machine itself, or 0.
    """

    active: int
    histories: tuple[int, ...]
    operations: tuple[tuple[int, Operation], ...]
    starts: tuple[int, ...]
    final: int


class MicrostepBuilder:
    """Compute microsteps from a configuration; methods are named as in Appendix D."""

    def __init__(self, machine: Machine, active: int, histories: tuple[int, ...]) -> None:
        self.machine = machine
        self.active = active
        self.histories = histories
        self.held = dict(zip(machine.every_history, histories, strict=True))
        self.entered = 0
        self.by_default = 0
        self.from_history: dict[int, Edge] = {}

    def take(self, enabled: tuple[Edge, ...]) -> Microstep:
        """Compute exit, effects and entry of the enabled transitions."""
        machine = self.machine
        transitions = self._without_conflicts(enabled)
        left = 0
        for edge in transitions:
            left |= self._exit_set(edge)
        self._record(left)
        # A transition from a state to a history in it returns to the state's old content.
        for edge in transitions:
            for entered in edge.targets:
                self._add_descendants(entered)
            domain = self._domain(edge)
            for entered in self._effective_targets(edge):
                self._add_ancestors(entered, domain)
        program = self._exit_program(left)
        active = self.active & ~left
        for edge in transitions:
            if edge.source or edge.table.events:
                program.append((active, ObserverCall("taken", edge.table)))
            if edge.table.effect is not None:
                program.append((active, edge.table.effect))
        starts = []
        final = 0
        for number in members(self.entered):
            active |= 1 << number
            state = machine.states[number]
            program += [(active, each) for each in self._entry_operations(number, state)]
            if state.activity is not None:
                starts.append(number)
            if state.kind is Kind.FINAL:
                if machine.parents[number] == 0:
                    final = number
                program += [(active, each) for each in self._done(number, state, active)]
        histories = tuple(self.held.values())
        return Microstep(active, histories, tuple(program), tuple(starts), final)

    def leave(self) -> Microstep:
        """Compute the exit of all states at the end of the machine."""
        program = self._exit_program(self.active)
        return Microstep(0, self.histories, tuple(program), (), 0)

    def _without_conflicts(self, enabled: tuple[Edge, ...]) -> list[Edge]:
        """removeConflictingTransitions: keep one of two that exit the same state."""
        if len(enabled) == 1:
            return list(enabled)
        kept: list[Edge] = []
        for edge in enabled:
            leaves = self._exit_set(edge)
            rivals = [other for other in kept if self._exit_set(other) & leaves]
            if all(self.machine.inside[other.source] >> edge.source & 1 for other in rivals):
                kept = [other for other in kept if other not in rivals]
                kept.append(edge)
        return kept

    def _exit_set(self, edge: Edge) -> int:
        if not edge.targets:
            return 0
        return self.active & self.machine.inside[self._domain(edge)]

    def _domain(self, edge: Edge) -> int:
        """getTransitionDomain: the state that a transition does not exit."""
        machine = self.machine
        targets = self._effective_targets(edge)
        around = [*machine.ancestors(edge.source), 0]
        compound = machine.states[edge.source].kind is Kind.STATE and machine.children[edge.source]
        if edge.source == 0 or (edge.table.internal and compound):
            around.insert(0, edge.source)
        for number in around:
            if machine.states[number].kind is not Kind.PARALLEL and all(
                machine.inside[number] >> target & 1 for target in targets
            ):
                return number
        return 0

    def _effective_targets(self, edge: Edge) -> list[int]:
        """getEffectiveTargetStates: replace histories by their states."""
        found: list[int] = []
        for target in edge.targets:
            if target not in self.held:
                found.append(target)
            elif self.held[target]:
                found += members(self.held[target])
            else:
                default = self.machine.entries[target]
                assert default is not None
                found += self._effective_targets(default)
        return found

    def _add_descendants(self, number: int) -> None:
        """Procedure addDescendantStatesToEnter."""
        machine = self.machine
        if number in self.held:
            around = machine.parents[number]
            if self.held[number]:
                targets = members(self.held[number])
            else:
                default = machine.entries[number]
                assert default is not None
                self.from_history[around] = default
                targets = list(default.targets)
            self._add_all(targets, around)
            return
        self.entered |= 1 << number
        if machine.states[number].kind is Kind.PARALLEL:
            self._add_regions(number)
        elif machine.children[number]:
            self.by_default |= 1 << number
            initial = machine.entries[number]
            assert initial is not None
            self._add_all(initial.targets, number)

    def _add_all(self, targets: Iterable[int], around: int) -> None:
        for target in targets:
            self._add_descendants(target)
        for target in targets:
            self._add_ancestors(target, around)

    def _add_ancestors(self, number: int, around: int) -> None:
        """Procedure addAncestorStatesToEnter."""
        for ancestor in self.machine.ancestors(number):
            if ancestor == around:
                return
            self.entered |= 1 << ancestor
            if self.machine.states[ancestor].kind is Kind.PARALLEL:
                self._add_regions(ancestor)

    def _add_regions(self, parallel: int) -> None:
        for child in self.machine.children[parallel]:
            if not self.entered & (self.machine.inside[child] | 1 << child):
                self._add_descendants(child)

    def _exit_program(self, left: int) -> list[tuple[int, Operation]]:
        program: list[tuple[int, Operation]] = []
        active = self.active
        for number in reversed(members(left)):
            state = self.machine.states[number]
            program += [(active, each) for each in state.exit]
            if state.activity is not None:
                program.append((active, _Stop(number)))
            active &= ~(1 << number)
            program.append((active, ObserverCall("exited", state)))
        return program

    def _entry_operations(self, number: int, state: State) -> list[Operation]:
        operations: list[Operation] = [ObserverCall("entered", state)]
        if state.timed:
            operations.append(_Timed(state.id))
        operations += state.entry
        ways = [
            self.machine.entries[number] if self.by_default >> number & 1 else None,
            self.from_history.get(number),
        ]
        operations += [way.table.effect for way in ways if way and way.table.effect is not None]
        return operations

    def _done(self, number: int, state: State, active: int) -> list[Operation]:
        """Return the `done.state` operations of an entered final state."""
        machine = self.machine
        parent = machine.parents[number]
        if parent == 0:
            return []
        completed: list[Operation] = [_Done(machine.states[parent].id, state)]
        around = machine.parents[parent]
        if machine.states[around].kind is Kind.PARALLEL and self._is_final(around, active):
            completed.append(_Done(machine.states[around].id, None))
        return completed

    def _is_final(self, number: int, active: int) -> bool:
        """Procedure isInFinalState."""
        machine = self.machine
        children = machine.children[number]
        if machine.states[number].kind is Kind.PARALLEL:
            return all(self._is_final(child, active) for child in children)
        return any(
            machine.states[child].kind is Kind.FINAL and active >> child & 1 for child in children
        )

    def _record(self, left: int) -> None:
        """Record the active states in the histories of the exited states."""
        machine, active = self.machine, self.active
        for history in self.held:
            around = machine.parents[history]
            if left >> around & 1:
                inside = members(machine.inside[around] & active)
                if machine.states[history].kind is Kind.DEEP_HISTORY:
                    found = [n for n in inside if not machine.inside[n] & active]
                else:
                    found = [n for n in inside if machine.parents[n] == around]
                self.held[history] = sum(1 << n for n in found)


class ObserverCall:
    """Operation that notifies the observer."""

    __slots__ = ("call", "what")

    def __init__(self, call: str, what: State | Transition) -> None:
        self.call = call
        self.what = what

    def __call__(self, instance: Executor, event: Event) -> None:
        """Call the method of the observer."""
        getattr(instance.observer, self.call)(instance, self.what)


class _Stop:
    """Operation that cancels the activity of an exited state."""

    __slots__ = ("number",)

    def __init__(self, number: int) -> None:
        self.number = number

    def __call__(self, instance: Executor, event: Event) -> None:
        instance.stop_activity(self.number)


class _Timed:
    """Operation that notes the time at which a state is entered."""

    __slots__ = ("state",)

    def __init__(self, state: str) -> None:
        self.state = state

    def __call__(self, instance: Executor, event: Event) -> None:
        instance.note_entry(self.state)


class _Done:
    """Operation that raises `done.state`; without data if these fail (5.7)."""

    __slots__ = ("final", "name")

    def __init__(self, state: str, final: State | None) -> None:
        self.name = f"done.state.{state}"
        self.final = final

    def __call__(self, instance: Executor, event: Event) -> None:
        data: Any = None
        if self.final is not None and self.final.donedata is not None:
            try:
                data = self.final.donedata(instance, event)
            except FAILURES as error:
                instance.fail(error)
        instance.raise_event(Event(self.name, data))
