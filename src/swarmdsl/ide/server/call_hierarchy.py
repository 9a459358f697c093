"""Who can reach a state, and what it leads to; likewise who does a function or sends an event."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from swarmdsl.base.source import Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import occurrences_of, owner_at
from swarmdsl.syntax.ast import (
    Choice,
    Event,
    FinalState,
    Function,
    History,
    Node,
    Operation,
    Parallel,
    Region,
    Send,
    State,
    StateMachine,
    TopLevel,
    nodes_of,
    references,
    walk,
)

Ways = Mapping[Node, Sequence[Span]]

REACHED = (State, Parallel, Choice, History, FinalState, StateMachine, Function, Operation, Event)
_SOURCES = (State, Parallel, Region, Choice, History)


def ways_to(workspace: Workspace, node: Node) -> Ways:
    """What leads to something, each with the places where it does."""
    found: dict[Node, list[Span]] = {}
    for each in occurrences_of(node, workspace):
        source, _, end = each.span
        if each.declares or source.text.startswith(".", end) or source.path is None:
            continue  # a name that a path goes through is not where it leads
        file = workspace.file(source.path)
        owner = owner_at(file, each.span.start) if file is not None else None
        if owner is None or (isinstance(node, Event) and not _is_sent(owner, each.span)):
            continue
        places = found.setdefault(_source(owner, each.span), [])
        if each.span not in places:
            places.append(each.span)
    return found


def ways_from(workspace: Workspace, node: Node) -> Ways:
    """What something leads to, each with the places where it does."""
    found: dict[Node, list[Span]] = {}
    place = node.span.absolute
    file = workspace.file(place.source.path) if place.source.path is not None else None
    owner = owner_at(file, place.start) if file is not None else None
    for _, ref in references(owner) if owner is not None else ():
        span = ref.span.absolute
        if (
            isinstance(ref.target, REACHED)
            and owner is not None
            and place.start <= span.start < place.end
            and _source(owner, span) is node
            and (not isinstance(ref.target, Event) or _is_sent(owner, span))
        ):
            found.setdefault(ref.target, []).append(span)
    return found


def _source(owner: TopLevel, span: Span) -> Node:
    """What a place in a declaration belongs to: the innermost state around it."""
    found: Node = owner
    for node in walk(owner):
        if isinstance(node, _SOURCES):
            _, start, end = node.span.absolute
            if start <= span.start and span.end <= end:
                found = node
    return found


def _is_sent(owner: TopLevel, span: Span) -> bool:
    return any(
        send.event.span.absolute.start <= span.start < send.event.span.absolute.end
        for send in nodes_of(owner, Send)
    )
