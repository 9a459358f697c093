"""What a machine does next, as an automaton that is built on the way.

Which transitions an event enables, and what taking them leaves and enters, depends on the
active states and on what the histories hold, not on an instance. Both are worked out when they
are first needed and kept in the machine: instances go from one `Configuration` to the next.
"""

from __future__ import annotations

from collections.abc import Iterable

from .step import Microstep, MicrostepBuilder, ObserverCall
from .table import Edge, Event, InstanceLike, Machine, members

_CACHE_SIZE = 20_000
"""How many decisions a machine keeps; there are as many configurations as one likes."""


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
    """Which step an event leads to: one that is known, or one that guards decide.

    `candidates` are the transitions to try for each active state without active children.
    """

    __slots__ = ("candidates", "step")

    def __init__(self, step: Step | None, candidates: tuple[tuple[Edge, ...], ...] = ()) -> None:
        self.step = step
        self.candidates = candidates

    def choose(self, instance: InstanceLike, event: Event) -> list[Edge]:
        """The transitions that guards let through: for each path, the first that holds."""
        enabled: list[Edge] = []
        refused: list[Edge] = []
        for path in self.candidates:
            for edge in path:
                if edge in enabled:
                    break
                if edge in refused:
                    continue
                if edge.guard is None or instance.holds(edge.guard, event):
                    enabled.append(edge)
                    break
                refused.append(edge)
        return enabled


_NOTHING = Decision(None)


class Configuration:
    """The active states and what each history of the machine holds, sets of numbers."""

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
        """The ids of the active states, in document order."""
        return [self.machine.states[number].id for number in members(self.active)]

    @property
    def innermost(self) -> list[str]:
        """The ids of the active states that have no active children."""
        return [self.machine.states[number].id for number in self._leaves()]

    def _leaves(self) -> list[int]:
        machine = self.machine
        return [n for n in members(self.active) if not machine.inside[n] & self.active]

    def at(self, active: int, histories: tuple[int, ...]) -> Configuration:
        """Another configuration of the machine, one object as long as it is remembered."""
        known: Configuration | None = self.machine.configurations.get((active, histories))
        return known if known is not None else Configuration(self.machine, active, histories)

    def decide(self, name: str) -> Decision:
        """What an event of that name leads to; none is meant by the empty name."""
        known = self._by_event.get(name)
        if known is not None:
            return known
        machine = self.machine
        candidates = []
        for leaf in self._leaves():
            path = []
            for number in (leaf, *machine.ancestors(leaf)):
                path += [edge for edge in machine.edges[number] if edge.matches(name)]
            without = next((i for i, edge in enumerate(path) if edge.guard is None), len(path))
            if path:
                candidates.append(tuple(path[: without + 1]))
        self._remember()
        if not candidates:
            decision = _NOTHING
        elif any(path[0].guard is not None for path in candidates):
            decision = Decision(None, tuple(candidates))
        else:
            decision = Decision(self.step(dict.fromkeys(path[0] for path in candidates)))
        self._by_event[name] = decision
        return decision

    def step(self, enabled: Iterable[Edge]) -> Step:
        """The step of some transitions that are enabled together, in order."""
        key = tuple(enabled)
        known = self._by_transitions.get(key)
        if known is None:
            self._remember()
            known = self._by_transitions[key] = self._lead(self._builder().take(key))
        return known

    def end(self) -> Step:
        """The step that leaves all states."""
        return self._lead(self._builder().leave())

    def _builder(self) -> MicrostepBuilder:
        return MicrostepBuilder(self.machine, self.active, self.histories)

    def _lead(self, microstep: Microstep) -> Step:
        return Step(microstep, self.at(microstep.active, microstep.histories))

    def _remember(self) -> None:
        """Keep the machine from remembering more and more: it begins again instead."""
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
    """The configuration in which nothing is active yet."""
    return Configuration(machine, 0, machine.blank).at(0, machine.blank)
