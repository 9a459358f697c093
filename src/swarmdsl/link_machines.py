"""Names inside a state machine: targets of transitions, regions, final states.

A name is looked for where the transition starts: among the states beside its source,
then outwards level by level, then inside the source. A path (`Search.Sweep`) goes down
from the state its first name means.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeVar

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.scopes import FileScope, report_unresolved
from swarmdsl.syntax import (
    Branch,
    Choice,
    Container,
    DoneTrigger,
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

V = TypeVar("V", bound=Vertex | Region)


def link_machine(machine: StateMachine, scope: FileScope, report: Diagnostics) -> None:
    """Resolve the references between the states of a machine."""
    _link_container(machine, (), scope, report)


def vertices(container: Container) -> Iterator[Vertex]:
    """The states directly inside a container."""
    for item in container.items:
        if isinstance(item, (State, Parallel, Choice, FinalState)):
            yield item


def regions(state: Vertex | Container) -> list[Region]:
    """The regions of a parallel state."""
    if not isinstance(state, Parallel):
        return []
    return [item for item in state.items if isinstance(item, Region)]


def content(state: Vertex | Container) -> Container | None:
    """The container whose final states complete a state: itself or the machine it reuses."""
    if isinstance(state, State) and state.machine is not None:
        return state.machine.target
    return state if isinstance(state, (State, StateMachine, Region)) else None


def _link_container(
    container: Container, outer: tuple[Container, ...], scope: FileScope, report: Diagnostics
) -> None:
    """Link what stands in a container; `outer` are those around it, the innermost last."""
    around = (*outer, container)
    for item in container.items:
        match item:
            case Initial():
                _link_vertex(item.target, (container,), None, scope, report)
            case Transition():
                assert isinstance(container, (State, Parallel))
                _link_vertex(item.target, outer, container, scope, report)
                for trigger in item.triggers:
                    if isinstance(trigger, DoneTrigger):
                        _link_done(trigger, container, scope, report)
            case Choice():
                for branch in item.branches:
                    _link_branch(branch, around, scope, report)
            case State() | Parallel() | Region():
                _link_container(item, around, scope, report)


def _link_branch(
    branch: Branch, around: tuple[Container, ...], scope: FileScope, report: Diagnostics
) -> None:
    _link_vertex(branch.target, around, None, scope, report)


def _link_vertex(
    ref: Ref[Vertex],
    around: tuple[Container, ...],
    source: State | Parallel | None,
    scope: FileScope,
    report: Diagnostics,
) -> None:
    first, *rest = ref.name.split(".")
    levels = [*reversed(around), *([source] if source else [])]
    found = next(
        (state for level in levels for state in vertices(level) if state.name == first), None
    )
    for name in rest:
        found = _below(found, name) if found is not None else None
    if found is not None:
        ref.target = found
    elif first not in scope.lost:
        candidates = [str(state.name) for level in levels for state in vertices(level)]
        report_unresolved("state", ref.name, ref.span, candidates, None, report)


def _below(state: Vertex, name: str) -> Vertex | None:
    """The state `name` inside another, regions not counted as a level of their own."""
    inside: list[Container] = list(regions(state))
    if isinstance(state, State):
        inside.append(state)
    return next((v for level in inside for v in vertices(level) if v.name == name), None)


def _link_done(
    trigger: DoneTrigger, owner: State | Parallel, scope: FileScope, report: Diagnostics
) -> None:
    """Resolve the region and the final state of a `done` trigger."""
    container = content(owner)
    if trigger.region is not None:
        _link_among(trigger.region, "region", regions(owner), scope, report)
        container = trigger.region.target
        if container is None:
            return
    if trigger.final is not None:
        finals = [v for v in vertices(container) if isinstance(v, FinalState)] if container else []
        _link_among(trigger.final, "final state", finals, scope, report)


def _link_among(
    ref: Ref[V], kind: str, candidates: list[V], scope: FileScope, report: Diagnostics
) -> None:
    ref.target = next((node for node in candidates if node.name == ref.name), None)
    if ref.target is None and ref.name not in scope.lost:
        names = [str(node.name) for node in candidates]
        report_unresolved(kind, ref.name, ref.span, names, None, report)
