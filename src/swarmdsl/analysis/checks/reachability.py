"""Checks of unreachable states."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.state_hierarchy import StateHierarchy
from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.analysis.resolve.states import all_resolved, regions, vertices
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.syntax.ast import (
    Branch,
    Choice,
    Container,
    DoneTrigger,
    FinalState,
    History,
    Parallel,
    Region,
    State,
    StateMachine,
    Transition,
    Vertex,
)


def check_reachability(machine: StateMachine, context: Context) -> None:
    """Report states without a path from the initial state.

    All guards and triggers are assumed to be possible. Of nested unreachable states only the
    outermost is reported. Errors are not reported twice: in a container without an initial state
    any state may be the first one, of states with the same name only the first is reported, and
    a machine with unresolved targets is skipped.
    """
    if not all_resolved(machine):
        return
    hierarchy = context.hierarchy(machine)
    reached: set[Vertex | Region] = set()
    work = _initials(machine, hierarchy)
    while work:
        state = work.pop()
        if state in reached:
            continue
        reached.add(state)
        work += _successors(state, hierarchy)
        outer = hierarchy.parent[state]
        if not isinstance(outer, StateMachine):
            work.append(outer)  # the states around an active state are active too
    if reached.issuperset(hierarchy.vertices):
        return
    waiting = _waiting(reached, hierarchy)
    ended = {hierarchy.parent[end] for end in reached if isinstance(end, FinalState)}
    for state in _unreached(machine, reached):
        context.report.report(
            "unreachable-state",
            state.name.span,
            kind=kind_name(state),
            name=state.name,
            related=tuple(
                Label(trigger.span, "so this never happens")
                for trigger in _waiting_in_vain(state, waiting, ended, hierarchy)
            ),
        )


def _initials(container: Container, hierarchy: StateHierarchy) -> list[Vertex | Region]:
    """States entered with a container: its regions or its initial state."""
    initials = hierarchy.initials[container]
    if not initials:
        return [*hierarchy.children[container]]
    return [item.target.target for item in initials if item.target.target is not None]


def _successors(state: Vertex | Region, hierarchy: StateHierarchy) -> list[Vertex | Region]:
    """States entered with a state, and the targets of its transitions."""
    found: list[Vertex | Region] = []
    arrows: Sequence[Transition | Branch] = ()
    match state:
        case State() | Parallel():
            found, arrows = _initials(state, hierarchy), hierarchy.transitions[state]
        case Region():
            found = _initials(state, hierarchy)
        case Choice():
            arrows = state.branches
        case History():
            found = [state.default] if state.default is not None else []
    targets = [arrow.target.target for arrow in arrows if arrow.target is not None]
    return found + [target for target in targets if target is not None]


# `done` triggers by the final state they wait for; by the container for any final state of it.
_Waiting = Mapping[Vertex | Container | None, Sequence[DoneTrigger]]


def _waiting(reached: set[Vertex | Region], hierarchy: StateHierarchy) -> _Waiting:
    """`done` triggers in reached states."""
    found: dict[Vertex | Container | None, list[DoneTrigger]] = {}
    for owner, transitions in hierarchy.transitions.items():
        if owner not in reached:
            continue
        for transition in transitions:
            for trigger in transition.triggers:
                if isinstance(trigger, DoneTrigger):
                    of = trigger.region.target if trigger.region is not None else owner
                    end = of if trigger.final is None else trigger.final.target
                    found.setdefault(end, []).append(trigger)
    return found


def _waiting_in_vain(
    final: Vertex, waiting: _Waiting, ended: set[Container], hierarchy: StateHierarchy
) -> list[DoneTrigger]:
    """Return the triggers that wait for an unreached final state.

    `ended` are the containers with a reached final state. A parallel state waits for all of its
    regions, a region for any of its final states.
    """
    if not isinstance(final, FinalState):
        return []
    container = hierarchy.parent[final]
    found = [*waiting.get(final, ())]
    if container not in ended:
        found += waiting.get(container, ())
        if isinstance(container, Region):
            found += waiting.get(hierarchy.parent[container], ())
    return sorted(found, key=lambda trigger: trigger.span.start)


def _unreached(container: Container, reached: set[Vertex | Region]) -> Iterator[Vertex]:
    """Yield the outermost unreached states, of several with one name the first."""
    for region in regions(container):
        yield from _unreached(region, reached)
    names = set()
    for state in vertices(container):
        if state in reached:
            if isinstance(state, (State, Parallel)):
                yield from _unreached(state, reached)
        elif state.name not in names:
            yield state
        names.add(state.name)
