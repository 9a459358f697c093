"""Which states and regions of a machine are in which, and what each holds: looked for once."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl.syntax.ast import (
    Choice,
    Container,
    FinalState,
    History,
    Initial,
    Parallel,
    Region,
    State,
    StateMachine,
    Transition,
    Vertex,
)


class Outline:
    """What all rules ask of a machine; the same for a machine that does not change.

    All is in document order. `vertices` are beside the states themselves all that transitions
    lead to; `inside` are those directly in a container, of a parallel state its regions.
    """

    def __init__(self, machine: StateMachine) -> None:
        self.machine = machine
        self.vertices: list[Vertex] = []
        self.states: list[State | Parallel] = []
        self.transitions: dict[State | Parallel, Sequence[Transition]] = {}
        self.inside: dict[Container, Sequence[Vertex | Region]] = {}
        self.initials: dict[Container, Sequence[Initial]] = {}
        self.container: dict[Vertex | Region, Container] = {}
        self._paths: dict[Vertex | Container, Sequence[Vertex | Container]] = {machine: [machine]}
        ahead: list[Vertex | Container] = [machine]
        while ahead:
            each = ahead.pop()
            if not isinstance(each, (StateMachine, Region)):
                self.vertices.append(each)
            if not isinstance(each, (Choice, History, FinalState)):
                self._add(each)
                ahead += reversed(self.inside[each])

    def _add(self, container: Container) -> None:
        """Note what a container holds."""
        transitions: list[Transition] = []
        initials: list[Initial] = []
        inside: list[Vertex | Region] = []
        for item in container.items:
            if isinstance(item, Transition):
                transitions.append(item)
            elif isinstance(item, Initial):
                initials.append(item)
            elif isinstance(item, (State, FinalState, Choice, Region, Parallel, History)):
                inside.append(item)
                self.container[item] = container
                self._paths[item] = [*self._paths[container], item]
        self.initials[container] = initials
        self.inside[container] = inside
        if isinstance(container, (State, Parallel)):
            self.states.append(container)
            self.transitions[container] = transitions

    def around(self, inside: Vertex | Region) -> Iterator[Container]:
        """What a state or a region is in, from the inside to the machine."""
        container = self.container[inside]
        while not isinstance(container, StateMachine):
            yield container
            container = self.container[container]
        yield container

    def path(self, inside: Vertex | Region) -> Sequence[Vertex | Container]:
        """The same from the machine to the state itself."""
        return self._paths[inside]
