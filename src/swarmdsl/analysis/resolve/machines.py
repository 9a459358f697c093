"""Names inside a state machine: targets of transitions, regions, final states.

A name is looked for where the transition starts: among the states beside its source,
then outwards level by level, then inside the source. A path (`Search.Sweep`) goes down
from the state its first name means. States in another region of the same parallel state
come last: no transition can lead there, which is reported later.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeVar

from swarmdsl.analysis.resolve.scopes import FileScope, report_unresolved
from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    Branch,
    Choice,
    Container,
    DoneTrigger,
    FinalState,
    History,
    Initial,
    Parallel,
    Ref,
    Region,
    State,
    StateMachine,
    Transition,
    Vertex,
    nodes_of,
    walk,
)

V = TypeVar("V", bound=Vertex | Region)

# States by name; several of one name are in different regions.
Level = Mapping[str, Sequence[Vertex]]


def link_machine(machine: StateMachine, scope: FileScope, report: Diagnostics) -> None:
    """Resolve the references between the states of a machine."""
    _link_container(machine, (), (), scope, report)


def vertices(container: Container) -> list[Vertex]:
    """The states directly inside a container."""
    kinds = (State, FinalState, Choice, Parallel, History)
    return [item for item in container.items if isinstance(item, kinds)]


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


def all_resolved(container: Container) -> bool:
    """Whether each transition and initial state inside leads to a state that was found."""
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


def _link_container(
    container: Container,
    outer: tuple[Level, ...],
    beside: tuple[Level, ...],
    scope: FileScope,
    report: Diagnostics,
) -> None:
    """Link what stands in a container.

    `outer` are the states around it, the nearest first, `beside` those in all regions of
    the parallel states around it.
    """
    inside = _by_name(container)
    for item in container.items:
        match item:
            case Transition():
                assert isinstance(container, (State, Parallel))
                if item.target is not None:
                    _link_vertex(item.target, (*outer, inside, *beside), scope, report)
                for trigger in item.triggers:
                    if isinstance(trigger, DoneTrigger):
                        _link_done(trigger, container, scope, report)
            case Initial() if inside or not isinstance(container, State):
                # An initial state in a state without states is reported as such.
                _link_inside(item, container, inside, (*outer, *beside), scope, report)
            case Choice():
                for branch in item.branches:
                    _link_vertex(branch.target, (inside, *outer, *beside), scope, report)
            case History():
                _link_inside(item, container, inside, (*outer, *beside), scope, report)
            case Region():
                _link_container(item, outer, (inside, *beside), scope, report)
            case State() | Parallel():
                _link_container(item, (inside, *outer), beside, scope, report)


def _by_name(state: Vertex | Container) -> Level:
    """The states inside another, regions not counted as a level of their own."""
    containers: list[Container] = [*regions(state)]
    if isinstance(state, (State, StateMachine, Region)):
        containers.append(state)
    names: dict[str, list[Vertex]] = {}
    for container in containers:
        # The second of two in one container is reported there.
        first = {str(inside.name): inside for inside in reversed(vertices(container))}
        for name, inside in first.items():
            names.setdefault(name, []).append(inside)
    return names


def _link_inside(
    arrow: Initial | History,
    container: Container,
    inside: Level,
    around: tuple[Level, ...],
    scope: FileScope,
    report: Diagnostics,
) -> None:
    """Resolve where an initial state or a history leads: to a state inside its own."""
    name = arrow.target.name
    outside = next((level[name][0] for level in around if name in level), None)
    if outside is None or name in inside:
        _link_vertex(arrow.target, (inside,), scope, report)
        return
    what = "`initial` names" if isinstance(arrow, Initial) else f"history `{arrow.name}` leads to"
    report.report(
        "unresolved-name",
        arrow.target.span,
        kind=f"state in `{container.name}`",
        name=name,
        related=(Label(outside.name.span, "this one is not inside"),),
        help=f"{what} a state inside `{container.name}`",
    )


def _link_vertex(
    ref: Ref[Vertex], levels: tuple[Level, ...], scope: FileScope, report: Diagnostics
) -> None:
    """Resolve a path to a state: its first name in the levels in sight, the nearest first."""
    outer: Vertex | None = None
    start = ref.span.start
    for name in ref.name.split("."):
        if outer is not None:
            levels = (_by_name(outer),)
        found = next((level[name] for level in levels if name in level), ())
        if len(found) != 1:
            at = Span(ref.span.source, start, start + len(name))
            if found:
                _report_ambiguous(name, at, found, report)
            elif name not in scope.lost:
                _report_missing_state(name, at, outer, levels, report)
            return
        outer = found[0]
        start += len(name) + 1
    ref.target = outer


def _report_ambiguous(name: str, at: Span, found: Sequence[Vertex], report: Diagnostics) -> None:
    report.report(
        "ambiguous-name",
        at,
        name=name,
        related=tuple(Label(state.name.span, "declared here") for state in found),
        help="give the states in the regions different names",
    )


def _report_missing_state(
    name: str, at: Span, outer: Vertex | None, levels: tuple[Level, ...], report: Diagnostics
) -> None:
    """Report a name that no state in sight has; `outer` is the state it should be in."""
    kind = "state" if outer is None else f"state in `{outer.name}`"
    if not report.wants_hint("unresolved-name"):
        report.report("unresolved-name", at, kind=kind, name=name)
        return
    states = [state for level in levels for found in level.values() for state in found]
    ways = (_way_to(name, state) for state in states)
    way = next((way for way in ways if way), [])
    if way:
        report.report(
            "unresolved-name",
            at,
            kind="state",
            name=name,
            related=(Label(way[-1].name.span, "declared here, inside another state"),),
            help=f"write `{'.'.join(state.name for state in way)}`",
        )
        return
    report_unresolved(kind, name, at, [str(state.name) for state in states], None, report)


def _way_to(name: str, state: Vertex) -> list[Vertex]:
    """The states from one down to another inside it; none if there is none of that name."""
    if state.name == name:
        return [state]
    ways = (_way_to(name, inside) for found in _by_name(state).values() for inside in found)
    return next(([state, *way] for way in ways if way), [])


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
    if trigger.final is not None and container is not None:
        finals = [v for v in vertices(container) if isinstance(v, FinalState)]
        _link_among(trigger.final, "final state", finals, scope, report)


def _link_among(
    ref: Ref[V], kind: str, candidates: list[V], scope: FileScope, report: Diagnostics
) -> None:
    ref.target = next((node for node in candidates if node.name == ref.name), None)
    if ref.target is None and ref.name not in scope.lost:
        names = [str(node.name) for node in candidates]
        report_unresolved(kind, ref.name, ref.span, names, None, report)
