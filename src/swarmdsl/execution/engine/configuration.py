"""Automaton over configurations, built lazily.

The transitions that an event enables, and the states that they exit and enter, depend only on the
active states and the histories, not on the instance. Both are computed on first use and cached in
the machine: instances go from one `Configuration` to the next.
"""

from __future__ import annotations

from collections.abc import Iterable

from .step import Microstep, MicrostepBuilder, ObserverCall
from .table import Edge, Event, InstanceLike, Machine, matches, members

_CACHE_SIZE = 20_000
"""Number of decisions that a machine caches; configurations are unlimited."""


class Step:
    """A microstep from one configuration to the next.

    `program` holds the operations in order, each with the states that are active at that moment;
    `traced` also calls the observer. A `quiet` step ends where only an event can lead on, unless
    its program raises one.
    """

    __slots__ = ("final", "program", "quiet", "starts", "target", "traced")

    def __init__(self, microstep: Microstep, target: Configuration) -> None:
        self.target = target
        self.traced = microstep.operations
        self.program = tuple([o for o in self.traced if not isinstance(o[1], ObserverCall)])
        self.starts = microstep.starts
        self.final = microstep.final
        self.quiet = not (target.restless or self.starts or self.final)


class Decision:
    """Step that an event leads to: a fixed one, or one that guards select.

    `candidates` are the transitions to try for each atomic active state, each with the state that
    defers the event if none of them is enabled, or 0.
    """

    __slots__ = ("candidates", "step")

    def __init__(
        self, step: Step | None, candidates: tuple[tuple[tuple[Edge, ...], int], ...] = ()
    ) -> None:
        self.step = step
        self.candidates = candidates

    def choose(self, instance: InstanceLike, event: Event) -> tuple[list[Edge], bool]:
        """Return the enabled transitions, and True if there are none and the event is deferred.

        Of each path, the first transition is enabled whose guard holds. A deferral precedes the
        transitions of the states around it.
        """
        enabled: list[Edge] = []
        refused: list[Edge] = []
        deferring = 0
        for path, holder in self.candidates:
            for edge in path:
                if edge in enabled:
                    break
                if edge in refused:
                    continue
                if edge.guard is None or instance.holds(edge.guard, event):
                    enabled.append(edge)
                    break
                refused.append(edge)
            else:
                if holder:
                    deferring |= 1 << holder
        if deferring:
            inside = instance.machine.inside
            enabled = [edge for edge in enabled if not inside[edge.source] & deferring]
        return enabled, bool(deferring and not enabled)


_NOTHING = Decision(None)


class Configuration:
    """Active states, and the states that each history holds, as sets of numbers."""

    __slots__ = ("_by_event", "_by_transitions", "active", "histories", "machine", "restless")

    def __init__(self, machine: Machine, active: int, histories: tuple[int, ...]) -> None:
        self.machine = machine
        self.active = active
        self.histories = histories
        self.restless = bool(active & machine.eventless)
        self._by_event: dict[str, Decision] = {}
        self._by_transitions: dict[tuple[Edge, ...], Step] = {}

    @property
    def ids(self) -> list[str]:
        """Ids of the active states, in document order."""
        return [self.machine.states[number].id for number in members(self.active)]

    @property
    def innermost(self) -> list[str]:
        """Ids of the active states without active children."""
        return [self.machine.states[number].id for number in self._leaves()]

    def _leaves(self) -> list[int]:
        machine = self.machine
        return [n for n in members(self.active) if not machine.inside[n] & self.active]

    def at(self, active: int, histories: tuple[int, ...]) -> Configuration:
        """Return a configuration of the machine, the same object while cached."""
        known: Configuration | None = self.machine.configurations.get((active, histories))
        return known if known is not None else Configuration(self.machine, active, histories)

    def decide(self, name: str) -> Decision:
        """Return the decision for an event name; the empty name means no event."""
        known = self._by_event.get(name)
        if known is not None:
            return known
        machine = self.machine
        candidates = []
        for leaf in self._leaves():
            path: list[Edge] = []
            holder = 0
            for number in (leaf, *machine.ancestors(leaf)):
                path += [edge for edge in machine.edges[number] if edge.matches(name)]
                if name and matches(machine.states[number].deferred, name):
                    holder = number
                    break
            without = next((i for i, edge in enumerate(path) if edge.guard is None), len(path))
            if path or holder:
                always = without < len(path)
                candidates.append((tuple(path[: without + 1]), 0 if always else holder))
        self._remember()
        if not candidates:
            decision = _NOTHING
        elif any(holder or path[0].guard is not None for path, holder in candidates):
            decision = Decision(None, tuple(candidates))
        else:
            decision = Decision(self.step(dict.fromkeys(path[0] for path, _ in candidates)))
        self._by_event[name] = decision
        return decision

    def step(self, enabled: Iterable[Edge]) -> Step:
        """Return the step of transitions that are enabled together, in order."""
        key = tuple(enabled)
        known = self._by_transitions.get(key)
        if known is None:
            self._remember()
            known = self._by_transitions[key] = self._lead(self._builder().take(key))
        return known

    def end(self) -> Step:
        """Return the step that exits all states."""
        return self._lead(self._builder().leave())

    def _builder(self) -> MicrostepBuilder:
        return MicrostepBuilder(self.machine, self.active, self.histories)

    def _lead(self, microstep: Microstep) -> Step:
        return Step(microstep, self.at(microstep.active, microstep.histories))

    def _remember(self) -> None:
        """Cache this configuration; clear the cache when it is full."""
        machine = self.machine
        machine.cached += 1
        if machine.cached > _CACHE_SIZE:
            for each in machine.configurations.values():
                each._by_event.clear()
                each._by_transitions.clear()
            machine.configurations.clear()
            machine.cached = 0
        machine.configurations[self.active, self.histories] = self


def before_start(machine: Machine) -> Configuration:
    """Return the configuration without active states."""
    return Configuration(machine, 0, machine.blank).at(0, machine.blank)
