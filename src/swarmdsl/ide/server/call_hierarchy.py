"""Call hierarchy of states, functions, operations and events.

Transitions are the calls between states; activities call functions and operations; `send` calls an
event.
"""

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

Calls = Mapping[Node, Sequence[Span]]

CALLABLE = (State, Parallel, Choice, History, FinalState, StateMachine, Function, Operation, Event)
_SOURCES = (State, Parallel, Region, Choice, History)


def incoming_calls(workspace: Workspace, node: Node) -> Calls:
    """Return the callers of an element, each with the spans of its calls."""
    found: dict[Node, list[Span]] = {}
    for each in occurrences_of(node, workspace):
        source, _, end = each.span
        if each.declares or source.text.startswith(".", end) or source.path is None:
            continue  # prefix of a qualified name, not its target
        file = workspace.file(source.path)
        owner = owner_at(file, each.span.start) if file is not None else None
        if owner is None or (isinstance(node, Event) and not _is_sent(owner, each.span)):
            continue
        places = found.setdefault(_source(owner, each.span), [])
        if each.span not in places:
            places.append(each.span)
    return found


def outgoing_calls(workspace: Workspace, node: Node) -> Calls:
    """Return the elements that an element calls, each with the spans of the calls."""
    found: dict[Node, list[Span]] = {}
    place = node.span.absolute
    file = workspace.file(place.source.path) if place.source.path is not None else None
    owner = owner_at(file, place.start) if file is not None else None
    for _, ref in references(owner) if owner is not None else ():
        span = ref.span.absolute
        if (
            isinstance(ref.target, CALLABLE)
            and owner is not None
            and place.start <= span.start < place.end
            and _source(owner, span) is node
            and (not isinstance(ref.target, Event) or _is_sent(owner, span))
        ):
            found.setdefault(ref.target, []).append(span)
    return found


def _source(owner: TopLevel, span: Span) -> Node:
    """Return the innermost state around a span, else the declaration."""
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
