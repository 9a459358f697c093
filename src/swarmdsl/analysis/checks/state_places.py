"""Places of states in a machine: its states with those of the machines that they reuse.

A state of a reused machine has a place for each use of it. Targets of transitions are looked up
in the same use.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from swarmdsl.analysis.resolve.states import content, regions, vertices
from swarmdsl.base.records import dataclass, field
from swarmdsl.syntax.ast import (
    Container,
    FinalState,
    Initial,
    Parallel,
    Ref,
    Region,
    State,
    StateMachine,
    Transition,
    Vertex,
)


@dataclass(slots=True, eq=False)
class Place:
    """State or region at one place, with the places around and inside it.

    `known` are the places of the same use of a machine, by their nodes.
    """

    node: Vertex | Region
    around: Place | None
    known: dict[Vertex | Region, Place]
    inside: list[Place] = field(default_factory=list)
    entered: list[Ref[Vertex]] = field(default_factory=list)

    @property
    def name(self) -> str:
        """Path of the state, without regions and reused machines."""
        names = [str(each.node.name) for each in self.chain() if not isinstance(each.node, Region)]
        return ".".join(reversed(names))

    def is_called(self, path: str) -> bool:
        """Return True for a place of this path, in which places around may be left out."""
        *around, name = path.split(".")
        own, *others = [str(each.node.name) for each in self.chain()]
        left = iter(others)
        return own == name and all(each in left for each in reversed(around))

    def chain(self) -> Iterator[Place]:
        """Yield the place and those around it, the innermost first."""
        place: Place | None = self
        while place is not None:
            yield place
            place = place.around

    def leaves(self) -> Iterator[Place]:
        """Yield the places inside that have no others inside them, or the place itself."""
        if not self.inside:
            yield self
        for each in self.inside:
            yield from each.leaves()

    def transitions(self) -> list[Transition]:
        """Return the transitions of the state."""
        if not isinstance(self.node, (State, Parallel)):
            return []
        return [item for item in self.node.items if isinstance(item, Transition)]

    def target(self, ref: Ref[Vertex] | None) -> Place | None:
        """Return the place that a transition of this state, or its initial state, leads to."""
        target = ref.target if ref is not None else None
        return self.known.get(target) if target is not None else None

    def first(self) -> list[Place]:
        """Return the places that are entered with this one: initial states, or all regions."""
        if isinstance(self.node, Parallel):
            return self.inside
        if not self.inside:
            return []
        inner = self.inside[0]
        return [found for ref in self.entered if (found := inner.target(ref)) is not None]

    @property
    def is_final(self) -> bool:
        """True for a final state."""
        return isinstance(self.node, FinalState)


@contextmanager
def places_of(machine: StateMachine) -> Iterator[list[Place]]:
    """Yield the outermost places of a machine; then take them apart, since they know each other."""
    places = _grow(machine, None, {}, frozenset((machine,)))
    try:
        yield places
    finally:
        for place in [*inside(places)]:
            place.inside = []
            place.known.clear()


def inside(places: Iterable[Place]) -> Iterator[Place]:
    """Yield places with all places inside them."""
    for place in places:
        yield place
        yield from inside(place.inside)


def _grow(
    container: Container,
    around: Place | None,
    known: dict[Vertex | Region, Place],
    reused: frozenset[StateMachine],
) -> list[Place]:
    found = []
    for vertex in vertices(container):
        place = Place(vertex, around, known)
        known[vertex] = place
        found.append(place)
        inner = content(vertex) if isinstance(vertex, State) else None
        if isinstance(inner, StateMachine):
            if inner not in reused:
                place.entered = _initials(inner)
                place.inside = _grow(inner, place, {}, reused | {inner})
        elif inner is not None:
            place.entered = _initials(inner)
            place.inside = _grow(inner, place, known, reused)
        for region in regions(vertex):
            part = Place(region, place, known)
            known[region] = part
            part.entered = _initials(region)
            part.inside = _grow(region, part, known, reused)
            place.inside.append(part)
    return found


def _initials(container: Container) -> list[Ref[Vertex]]:
    return [item.target for item in container.items if isinstance(item, Initial)]
