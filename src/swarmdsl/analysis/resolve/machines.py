"""Resolve names inside a state machine: targets of transitions, regions, final states.

The lookup starts at the source of a transition: its siblings, then outwards level by level,
then the states inside the source. A path (`Search.Sweep`) leads down from its first name.
States in another region of the same parallel state come last: a transition to them is an
error that a check reports.
"""

from __future__ import annotations

from typing import TypeVar

from swarmdsl.analysis.resolve.report_unresolved import (
    report_ambiguous_state,
    report_missing_inside,
    report_missing_state,
    report_state_outside,
)
from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.analysis.resolve.states import Level, content, regions, states_by_name, vertices
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
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
)

V = TypeVar("V", bound=Vertex | Region)


def link_machine(machine: StateMachine, scope: FileScope, report: Diagnostics) -> None:
    """Resolve the references between the states of a machine."""
    _link_container(machine, (), (), scope, report)


def _link_container(
    container: Container,
    outer: tuple[Level, ...],
    beside: tuple[Level, ...],
    scope: FileScope,
    report: Diagnostics,
) -> None:
    """Link the contents of a container.

    `outer` are the levels around it, the nearest first, `beside` the levels of all regions of
    the parallel states around it.
    """
    inside = states_by_name(container)
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
                # A check reports an initial state in a state without states.
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


def _link_inside(
    arrow: Initial | History,
    container: Container,
    inside: Level,
    around: tuple[Level, ...],
    scope: FileScope,
    report: Diagnostics,
) -> None:
    """Resolve the target of an initial state or a history: a state inside its container."""
    name = arrow.target.name
    outside = next((level[name][0] for level in around if name in level), None)
    if outside is None or name in inside:
        _link_vertex(arrow.target, (inside,), scope, report)
        return
    report_state_outside(arrow, container, outside, report)


def _link_vertex(
    ref: Ref[Vertex], levels: tuple[Level, ...], scope: FileScope, report: Diagnostics
) -> None:
    """Resolve a path to a state, its first name in the nearest level that has it."""
    outer: Vertex | None = None
    start = ref.span.start
    for name in ref.name.split("."):
        if outer is not None:
            levels = (states_by_name(outer),)
        found = next((level[name] for level in levels if name in level), ())
        if len(found) != 1:
            at = Span(ref.span.source, start, start + len(name))
            if found:
                report_ambiguous_state(name, at, found, report)
            else:
                report_missing_state(name, at, outer, levels, scope, report)
            return
        outer = found[0]
        start += len(name) + 1
    ref.target = outer


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
    if ref.target is None:
        names = [str(node.name) for node in candidates]
        report_missing_inside(kind, ref.name, ref.span, names, scope, report)
