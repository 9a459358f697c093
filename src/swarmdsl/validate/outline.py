"""Which states and regions of a machine are in which, and what each holds: looked for once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from swarmdsl.syntax import (
    Container,
    Parallel,
    Region,
    State,
    StateMachine,
    Transition,
    Vertex,
    nodes_of,
    walk,
)


class Outline:
    """What all rules ask of a machine; the same for a machine that does not change."""

    def __init__(self, machine: StateMachine) -> None:
        self.machine = machine
        # Beside the states themselves all that transitions lead to, in document order.
        self.vertices: Sequence[Vertex] = [n for n in walk(machine) if isinstance(n, Vertex)]
        self.states: Sequence[State | Parallel] = [
            vertex for vertex in self.vertices if isinstance(vertex, (State, Parallel))
        ]
        self.transitions: Mapping[State | Parallel, Sequence[Transition]] = {
            state: [item for item in state.items if isinstance(item, Transition)]
            for state in self.states
        }
        containers: list[Container] = [machine, *self.states, *nodes_of(machine, Region)]
        self.container: Mapping[Vertex | Region, Container] = {
            item: container
            for container in containers
            for item in container.items
            if isinstance(item, (Vertex, Region))
        }

    def around(self, inside: Vertex | Region) -> Iterator[Container]:
        """What a state or a region is in, from the inside to the machine."""
        container = self.container[inside]
        while not isinstance(container, StateMachine):
            yield container
            container = self.container[container]
        yield container

    def path(self, inside: Vertex | Region) -> list[Vertex | Container]:
        """The same from the machine to the state itself."""
        return [inside, *self.around(inside)][::-1]
