"""Transitions of states beside each other that a state around them can have once.

`on Stop -> Home` at the end of each of some states becomes one transition of the state around them.
A transition of an inner state precedes those around it, so only the last ones of a state are
lifted, and only those on events, which mean the same one level further out.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence

from swarmdsl.analysis.resolve.states import vertices
from swarmdsl.base.records import dataclass
from swarmdsl.syntax.ast import (
    Container,
    Defer,
    Elapsed,
    EventTrigger,
    FinalState,
    InState,
    NameUse,
    Node,
    Parallel,
    State,
    Transition,
    Variable,
    Vertex,
    walk,
)

_Key = tuple[Hashable, ...]


@dataclass(frozen=True)
class Common:
    """One transition, as each of some states has it; the first of them is kept."""

    transitions: tuple[Transition, ...]

    @property
    def kept(self) -> Transition:
        """The transition of the first state."""
        return self.transitions[0]


def common_transitions(states: Sequence[Vertex]) -> list[Common]:
    """Return the transitions that all of some states have and a state around them can have."""
    owners = [each for each in states if isinstance(each, (State, Parallel))]
    if len(owners) < 2 or any(isinstance(node, Defer) for each in owners for node in walk(each)):
        return []
    inside = {node for each in states for node in walk(each)}
    tables = [_by_key(each, inside) for each in owners]
    keys = [key for key in tables[0] if all(key in table for table in tables)]
    while True:
        kept = [
            key
            for key in keys
            if all(
                _is_last(table[key], owner, table, keys)
                for table, owner in zip(tables, owners, strict=True)
            )
        ]
        if kept == keys:
            break
        keys = kept
    orders = [sorted(keys, key=lambda key: table[key].span.start) for table in tables]
    if any(order != orders[0] for order in orders):
        return []  # of two on one event, the first is taken
    return [Common(tuple(table[key] for table in tables)) for key in orders[0]]


def events_of(transition: Transition) -> set[object]:
    """Return the events that a transition is on."""
    triggers = (each for each in transition.triggers if isinstance(each, EventTrigger))
    return {each.event.target for each in triggers}


def is_on_events(transition: Transition) -> bool:
    """Return True for a transition on events alone, which is not internal."""
    events = all(isinstance(each, EventTrigger) for each in transition.triggers)
    return events and bool(transition.triggers) and not transition.internal


def always_handled(state: State | Parallel) -> set[object]:
    """Return the events on which a state, or whichever state is active in it, leaves none over."""
    own = (each for each in state.items if isinstance(each, Transition) and each.guard is None)
    found = {event for each in own for event in events_of(each)}
    inside = vertices(state) if isinstance(state, State) and state.machine is None else []
    if inside and not any(isinstance(each, FinalState) for each in inside):
        states = [each for each in inside if isinstance(each, (State, Parallel))]
        found |= set.intersection(*map(always_handled, states)) if states else set()
    return found


def measures_time(transition: Transition) -> bool:
    """Return True if an expression asks how long the state of the transition has been active."""
    return any(isinstance(node, Elapsed) and node.state is None for node in walk(transition))


def _by_key(state: State | Parallel, inside: set[Node]) -> dict[_Key, Transition]:
    """Return the transitions of a state that can be lifted, by what they mean."""
    found: dict[_Key, Transition] = {}
    twice: set[_Key] = set()
    for item in state.items:
        if isinstance(item, Transition) and is_on_events(item) and not _is_bound(item, inside):
            key = _key(item)
            twice |= {key} & found.keys()
            found[key] = item
    return {key: item for key, item in found.items() if key not in twice}


def _is_bound(transition: Transition, inside: set[Node]) -> bool:
    """Return True for a transition that is about its state, or a state beside it."""
    if transition.target is not None and transition.target.target in inside:
        return True
    for node in walk(transition):
        if isinstance(node, (Elapsed, InState)):
            return True
        if (
            isinstance(node, NameUse)
            and isinstance(node.target, Variable)
            and node.target in inside
        ):
            return True
    return False


def _key(transition: Transition) -> _Key:
    """Return the meaning of a transition: its words, but for its target the state itself."""
    span, target = transition.span, transition.target
    text = span.text
    if target is not None:
        text = text[: target.span.start - span.start]
    names = tuple(node.target for node in walk(transition) if isinstance(node, NameUse))
    return (*text.split(), names, target.target if target is not None else None)


def _is_last(
    transition: Transition, state: State | Parallel, table: dict[_Key, Transition], keys: list[_Key]
) -> bool:
    """Return True if no other transition of a state on the same event comes later and stays."""
    lifted = [table[key] for key in keys]
    later = [
        each
        for each in state.items
        if isinstance(each, Transition)
        and each.span.start > transition.span.start
        and each not in lifted
    ]
    return all(events_of(transition).isdisjoint(events_of(each)) for each in later)


def can_be_lifted(transition: Transition, state: State, around: Container) -> bool:
    """Return True if the state around a composite state can have one of its transitions.

    That is so if no state beside it would take the transition then.
    """
    if not isinstance(around, State) or not is_on_events(transition):
        return False
    others = [
        each
        for each in vertices(around)
        if each is not state and isinstance(each, (State, Parallel))
    ]
    deferred = any(isinstance(node, Defer) for each in others for node in walk(each))
    return not deferred and all(events_of(transition) <= always_handled(each) for each in others)
