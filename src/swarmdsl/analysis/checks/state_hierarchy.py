"""Hierarchy of the states and regions of a state machine."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl.syntax.ast import (
    Activity,
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


class StateHierarchy:
    """States, regions, initial states and transitions of a machine, in document order.

    `vertices` are all possible targets of transitions. `children` are the vertices directly
    in a container; those of a parallel state are its regions. `idle` are the states without
    activity, states inside and submachine: they complete as soon as they are entered.
    """

    def __init__(self, machine: StateMachine) -> None:
        self.machine = machine
        self.vertices: list[Vertex] = []
        self.states: list[State | Parallel] = []
        self.idle: set[State | Parallel] = set()
        self.transitions: dict[State | Parallel, Sequence[Transition]] = {}
        self.children: dict[Container, Sequence[Vertex | Region]] = {}
        self.initials: dict[Container, Sequence[Initial]] = {}
        self.parent: dict[Vertex | Region, Container] = {}
        self._paths: dict[Vertex | Container, Sequence[Vertex | Container]] = {machine: [machine]}
        ahead: list[Vertex | Container] = [machine]
        while ahead:
            each = ahead.pop()
            if not isinstance(each, (StateMachine, Region)):
                self.vertices.append(each)
            if not isinstance(each, (Choice, History, FinalState)):
                self._add(each)
                ahead += reversed(self.children[each])

    def _add(self, container: Container) -> None:
        """Add the contents of a container."""
        transitions: list[Transition] = []
        initials: list[Initial] = []
        inside: list[Vertex | Region] = []
        has_activity = False
        for item in container.items:
            if isinstance(item, Transition):
                transitions.append(item)
            elif isinstance(item, Initial):
                initials.append(item)
            elif isinstance(item, Activity):
                has_activity = True
            elif isinstance(item, (State, FinalState, Choice, Region, Parallel, History)):
                inside.append(item)
                self.parent[item] = container
                self._paths[item] = [*self._paths[container], item]
        self.initials[container] = initials
        self.children[container] = inside
        if isinstance(container, (State, Parallel)):
            self.states.append(container)
            self.transitions[container] = transitions
        if isinstance(container, State) and not (container.machine or inside or has_activity):
            self.idle.add(container)

    def ancestors(self, inside: Vertex | Region) -> Iterator[Container]:
        """Yield the containers of a state or a region, the innermost first, the machine last."""
        container = self.parent[inside]
        while not isinstance(container, StateMachine):
            yield container
            container = self.parent[container]
        yield container

    def path(self, inside: Vertex | Region) -> Sequence[Vertex | Container]:
        """Return the path from the machine down to a state or region, both included."""
        return self._paths[inside]
