"""Coverage of states and transitions.

Elements of the model text are counted: a reused machine is counted once, wherever it runs.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.execution.engine import Kind, Machine, Transition
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.ir import State as ModelState
from swarmdsl.ir import Transition as ModelTransition

_HISTORIES = (Kind.HISTORY, Kind.DEEP_HISTORY)
Key = tuple[str, int]
"""Source name and offset of an element; for a document, its file and a number."""


@dataclass
class MachineCoverage:
    """States and transitions of a machine as strings, and the reached ones."""

    name: str
    states: dict[Key, str] = field(default_factory=dict)
    transitions: dict[Key, str] = field(default_factory=dict)
    origins: dict[Key, object] = field(default_factory=dict)
    entered: set[Key] = field(default_factory=set)
    taken: set[Key] = field(default_factory=set)

    @property
    def missed(self) -> Iterator[str]:
        """Yield descriptions of the unreached elements."""
        for _, words in self.unreached:
            yield words

    @property
    def unreached(self) -> Iterator[tuple[object, str]]:
        """Yield unreached elements with their origins."""
        for key, words in self.states.items():
            if key not in self.entered:
                yield self.origins[key], f"never entered: {words}"
        for key, words in self.transitions.items():
            if key not in self.taken:
                yield self.origins[key], f"never taken: {words}"


@dataclass
class _Elements:
    """Elements of the model text for the states and transitions of a table."""

    states: dict[str, tuple[MachineCoverage, Key]] = field(default_factory=dict)
    transitions: dict[int, tuple[MachineCoverage, Key]] = field(default_factory=dict)


class Coverage:
    """Collect coverage from trace lines."""

    def __init__(self) -> None:
        self._machines: dict[tuple[str, str], MachineCoverage] = {}
        self._known: dict[Machine, _Elements] = {}
        self._files: dict[Machine, str] = {}

    def expect(self, subject: Subject) -> None:
        """Include all machines that a robot of the model runs, even if none runs now."""
        if subject.document is not None:
            self._files[subject.document.machine] = subject.document.source.name
            self.count(subject.document.machine)
        system = subject.system
        if system is None:
            return
        behaviours = {member.behavior for member in system.members}
        behaviours |= {component.behavior for component in system.components}
        if subject.machine is not None:
            behaviours.add(subject.machine.name)
        for machine in system.machines:
            if machine.name in behaviours:
                self.count(subject.table(machine))

    def count(self, machine: Machine) -> None:
        """Include a machine, even if it does nothing."""
        self._of(machine)

    def see(self, line: Line) -> None:
        """Process a trace line."""
        self.reach(line.actor.machine, line.entered, line.taken)

    def reach(
        self, machine: Machine, states: Iterable[str], transitions: Iterable[Transition]
    ) -> None:
        """Record states that were entered, as ids, and transitions that were taken."""
        known = self._of(machine)
        for state in states:
            if state in known.states:
                found, key = known.states[state]
                found.entered.add(key)
        for transition in transitions:
            if _identity(transition) in known.transitions:
                found, key = known.transitions[_identity(transition)]
                found.taken.add(key)

    def elements(self, machine: Machine) -> Mapping[str, tuple[MachineCoverage, Key]]:
        """Return what is counted of a machine, by the names that trace lines have for it."""
        known = self._of(machine)
        found = dict(known.states)
        for state in machine.states[1:]:
            for transition in state.transitions:
                element = known.transitions.get(_identity(transition))
                if element is not None:
                    found[machine.called(transition)] = element
        return found

    @property
    def machines(self) -> list[MachineCoverage]:
        """The machines, in order of their first appearance."""
        return list(self._machines.values())

    @property
    def percentage(self) -> float:
        """Percentage of reached states and transitions; 100 if there are none."""
        there = sum(len(each.states) + len(each.transitions) for each in self.machines)
        reached = sum(len(each.entered) + len(each.taken) for each in self.machines)
        return 100 * reached / there if there else 100.0

    def _of(self, machine: Machine) -> _Elements:
        known = self._known.get(machine)
        if known is None:
            known = self._known[machine] = _Elements()
            self._add(machine, known)
        return known

    def _add(self, machine: Machine, known: _Elements) -> None:
        owners = {0: (machine.name, "")}
        for number, state in enumerate(machine.states[1:], 1):
            owner, prefix = owners[machine.parents[number]]
            origin = state.origin
            owners[number] = owner, prefix
            if isinstance(origin, ModelState) and origin.submachine is not None:
                owners[number] = origin.submachine, f"{state.id}."
            if state.kind in _HISTORIES:
                continue
            key = self._key(origin, machine, number)
            name = state.id.removeprefix(prefix)
            row = self._machines.setdefault((key[0], owner), MachineCoverage(owner))
            row.states.setdefault(key, name)
            row.origins.setdefault(key, origin)
            known.states[state.id] = row, key
            for transition in state.transitions:
                # Regions of a parallel state may have copies of its transition.
                if _identity(transition) not in known.transitions:
                    number = len(machine.states) + len(known.transitions)
                    key = self._key(transition.origin, machine, number)
                    row.transitions.setdefault(key, f"{name}: {_words(transition)}")
                    row.origins.setdefault(key, transition.origin)
                    known.transitions[_identity(transition)] = row, key

    def _key(self, origin: object, machine: Machine, number: int) -> Key:
        place = place_of(origin)
        if place is None:
            # Two documents may have machines with the same name.
            return self._files.get(machine, machine.name), number
        return place.source.name, place.start


def _identity(transition: Transition) -> int:
    """Return a key that is the same for all engine transitions of a model transition."""
    modelled = isinstance(transition.origin, ModelTransition)
    return id(transition.origin if modelled else transition)


def place_of(origin: object) -> Span | None:
    """Return the span of an element in the model."""
    place = origin if isinstance(origin, Span) else getattr(origin, "origin", None)
    return place if isinstance(place, Span) else None


def _words(transition: Transition) -> str:
    place = place_of(transition.origin)
    if place is not None:
        return " ".join(place.text.split())
    return " ".join([*transition.events, "->", *transition.targets])
