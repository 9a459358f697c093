"""Contents of state machines, states and regions by name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from swarmdsl.syntax.ast import (
    Branch,
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
    Variable,
    Vertex,
    nodes_of,
    walk,
)

Level = Mapping[str, Sequence[Vertex]]
"""States by name. States of different regions can have the same name."""


def vertices(container: Container) -> list[Vertex]:
    """States directly inside a container."""
    kinds = (State, FinalState, Choice, Parallel, History)
    return [item for item in container.items if isinstance(item, kinds)]


def regions(state: Vertex | Container) -> list[Region]:
    """Regions of a parallel state."""
    if not isinstance(state, Parallel):
        return []
    return [item for item in state.items if isinstance(item, Region)]


def variables_of(container: Container) -> list[Variable]:
    """Variables declared directly in a container."""
    return [item for item in container.items if isinstance(item, Variable)]


def content(state: Vertex | Container) -> Container | None:
    """Container whose final states complete a state: the state or its submachine."""
    if isinstance(state, State) and state.machine is not None:
        return state.machine.target
    return state if isinstance(state, (State, StateMachine, Region)) else None


def all_resolved(container: Container) -> bool:
    """Return True if the target of each transition and initial state inside is resolved."""
    arrows: Iterable[Initial | Transition | Branch | History]
    if isinstance(container, StateMachine):
        arrows = [
            *nodes_of(container, Initial),
            *nodes_of(container, Transition),
            *nodes_of(container, Branch),
            *nodes_of(container, History),
        ]
    else:
        kinds = (Initial, Transition, Branch, History)
        arrows = (node for node in walk(container) if isinstance(node, kinds))
    return all(arrow.target is None or arrow.target.target is not None for arrow in arrows)


def states_by_name(state: Vertex | Container) -> Level:
    """States inside another one. Regions are not a level of their own."""
    containers: list[Container] = [*regions(state)]
    if isinstance(state, (State, StateMachine, Region)):
        containers.append(state)
    names: dict[str, list[Vertex]] = {}
    for container in containers:
        # A second state of the same name in one container is a repeated declaration.
        first = {str(inside.name): inside for inside in reversed(vertices(container))}
        for name, inside in first.items():
            names.setdefault(name, []).append(inside)
    return names
