"""Checks of conflicts between regions: transitions and assignments on the same event."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence

from swarmdsl.analysis.checks.conjunctions import satisfiable
from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.guard_satisfiability import condition_of
from swarmdsl.analysis.checks.state_hierarchy import StateHierarchy
from swarmdsl.analysis.event_topics import event_of, received_topic
from swarmdsl.analysis.resolve.states import regions
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    Event,
    FieldUse,
    IndexUse,
    MonitorTrigger,
    NameUse,
    Parallel,
    Region,
    StateMachine,
    Store,
    Transition,
    nodes_of,
)

# Real models have fewer for one event. Later ones are compared with these only.
_MAX_COMPARED = 50
_Source = Event | MonitorTrigger
# Transitions inside each region.
_Inside = Mapping[Region, Sequence[Transition]]


def check_conflicts(machine: StateMachine, context: Context) -> None:
    """Check the transitions on the same event in the regions of each parallel state."""
    parallels = nodes_of(machine, Parallel)
    if not parallels:
        return
    hierarchy = context.hierarchy(machine)
    inside: dict[Region, list[Transition]] = {region: [] for region in nodes_of(machine, Region)}
    for state, transitions in hierarchy.transitions.items():
        for outer in hierarchy.ancestors(state):
            if isinstance(outer, Region):
                inside[outer] += transitions
    for found in inside.values():
        found.sort(key=lambda transition: transition.span.start)
    for parallel in parallels:
        _check_exits(parallel, inside, hierarchy, context)
        _check_assignments(parallel, inside, hierarchy, context)


def _check_assignments(
    parallel: Parallel, inside: _Inside, hierarchy: StateHierarchy, context: Context
) -> None:
    """Report the second of two different assignments in two regions on one event.

    SCXML runs effects in document order (3.13), so the last one counts. Equal assignments
    (`n = n + 1`) do not depend on the order.
    """
    earlier: dict[Hashable, list[tuple[Transition, Store]]] = {}
    for region in regions(parallel):
        found = [
            store
            for transition in inside[region]
            if _stays(transition, region, hierarchy)
            for store in _stores(transition)
        ]
        for event, transition, effect in found:
            for before, first in earlier.get((_event_key(event), _path(effect)[0]), ()):
                if _differ(first, effect) and satisfiable(
                    condition_of(before, context), condition_of(transition, context)
                ):
                    context.report.report(
                        "conflicting-effects",
                        effect.span,
                        variable=effect.target.span.text,
                        event=_describe(event),
                        related=(Label(first.span, "this is done first, in another region"),),
                        help="assign in one of the regions, or give each a variable of its own",
                    )
                    break
        for event, transition, effect in found:
            others = earlier.setdefault((_event_key(event), _path(effect)[0]), [])
            if len(others) < _MAX_COMPARED:
                others.append((transition, effect))


def _stays(transition: Transition, region: Region, hierarchy: StateHierarchy) -> bool:
    if transition.target is None:
        return True
    target = transition.target.target
    return target is not None and region in hierarchy.ancestors(target)


def _stores(transition: Transition) -> Iterator[tuple[_Source, Transition, Store]]:
    """Yield the assignments of a transition for each of its events."""
    events = {_event_key(event): event for event in map(event_of, transition.triggers) if event}
    for event in events.values():
        for effect in transition.effects:
            if isinstance(effect, Store) and _path(effect):
                yield event, transition, effect


def _event_key(event: _Source) -> Hashable:
    return received_topic(event), event.type.type


def _differ(first: Store, second: Store) -> bool:
    """Return True if two assignments store different values in the same field."""
    one, other = _path(first), _path(second)
    length = min(len(one), len(other))
    return one[:length] == other[:length] and _words(first.span) != _words(second.span)


def _path(effect: Store) -> tuple[Hashable, ...]:
    """Variable and fields of the target of an assignment; empty if unresolved."""
    fields: list[str] = []
    tree = effect.target.tree
    if isinstance(tree, IndexUse):
        tree = tree.base  # the number of an item may be any
    while isinstance(tree, FieldUse):
        fields.insert(0, str(tree.name))
        tree = tree.base
    if not isinstance(tree, NameUse) or tree.target is None:
        return ()
    return (tree.target, *fields)


def _words(span: Span) -> str:
    return "".join(span.text.split())


def _describe(event: _Source) -> str:
    return f"event `{event.name}`" if isinstance(event, Event) else f"topic `{event.topic}`"


def _check_exits(
    parallel: Parallel, inside: _Inside, hierarchy: StateHierarchy, context: Context
) -> None:
    """Report the second of two transitions that leave a parallel state on one event.

    SCXML takes the first in document order (3.13), which is not obvious in a model.
    """
    leaving: dict[Hashable, tuple[Region, Transition]] = {}
    for region in regions(parallel):
        for transition in inside[region]:
            target = transition.target.target if transition.target is not None else None
            if target is None or region in hierarchy.ancestors(target):
                continue
            for event in map(event_of, transition.triggers):
                if event is None:
                    continue
                where, first = leaving.setdefault(_event_key(event), (region, transition))
                if where is region or (first.target and first.target.target is target):
                    continue
                context.report.report(
                    "conflicting-regions",
                    transition.span,
                    event=_describe(event),
                    state=parallel.name,
                    related=(Label(first.span, "this one is taken"),),
                    help=Advice(
                        f"move the transition to state `{parallel.name}`",
                        "move into",
                        parallel.name.span,
                    ),
                )
