"""Reactions of robots to the event of a contract, state by state."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.analysis.checks.conjunctions import negate, satisfiable
from swarmdsl.analysis.checks.facts import Condition
from swarmdsl.analysis.checks.guard_satisfiability import guard_condition
from swarmdsl.analysis.checks.state_places import Place
from swarmdsl.analysis.event_topics import event_of, received_topic
from swarmdsl.analysis.types import Typing
from swarmdsl.base.records import dataclass
from swarmdsl.syntax.ast import (
    Defer,
    Element,
    Event,
    Expression,
    NameUse,
    Node,
    Parallel,
    Param,
    State,
    Transition,
    walk,
)


@dataclass(frozen=True, slots=True)
class Answer:
    """Reaction of a robot in a state to an event: transitions that it may take.

    `covers` is True if it takes one of them for sure; `deferring` is the state that puts it off.
    """

    taken: tuple[tuple[Place, Transition], ...]
    covers: bool
    deferring: Place | None = None


class Answers:
    """Answers of the states of a machine to events under the guard of a contract.

    `given` are the items of the machine whose values a member sets.
    """

    def __init__(self, guard: Expression | None, typing: Typing, given: Iterable[Node]) -> None:
        self._guard = guard
        self._typing = typing
        self._params = {each for each in given if isinstance(each, Param)}

    def answer(self, leaf: Place, event: Event, limit: Place | None = None) -> Answer:
        """Return what a robot in a state does with an event, up to a place around it."""
        taken: list[tuple[Place, Transition]] = []
        guards: list[Condition] = []
        for owner in leaf.chain():
            if owner is limit:
                break
            for transition in owner.transitions():
                if not any(_is_event(event, each) for each in map(event_of, transition.triggers)):
                    continue
                taken.append((owner, transition))
                if transition.guard is None or self._holds(transition, guards):
                    return Answer(tuple(taken), covers=True)
            if _defers(owner, event):
                return Answer(tuple(taken), covers=False, deferring=owner)
        return Answer(tuple(taken), covers=False)

    def _holds(self, transition: Transition, guards: list[Condition]) -> bool:
        """Return True if one of the guards so far holds whenever that of the contract does."""
        own, guard = self._guard, transition.guard
        assert guard is not None
        if not _is_known(guard) or (own is not None and not _is_known(own)):
            return True  # reported elsewhere
        if own is not None and self._is_same(own, guard):
            return True
        assert guard.tree is not None  # it is known
        guards.append(negate(guard_condition(guard.tree, self._typing)))
        assumed = [guard_condition(own.tree, self._typing)] if own is not None and own.tree else []
        return not satisfiable(*assumed, *guards)

    def _is_same(self, one: Expression, other: Expression) -> bool:
        """Return True for guards of the same text whose names have the same values."""
        if one.span.text.split() != other.span.text.split():
            return False
        uses = [
            [each for each in walk(guard) if isinstance(each, NameUse)] for guard in (one, other)
        ]
        # A param of a member sets the param of its machine with the same name.
        return all(
            first.target is second.target
            or isinstance(second.target, Element)
            or (isinstance(first.target, Param) and second.target in self._params)
            for first, second in zip(*uses, strict=True)
        )


def _is_known(guard: Expression) -> bool:
    """Return True if a guard is complete, and all names in it are declared."""
    names = (each for each in walk(guard) if isinstance(each, NameUse))
    return guard.tree is not None and all(
        each.is_predefined or each.target is not None for each in names
    )


def _is_event(event: Event, other: object) -> bool:
    if other is None or other is event:
        return other is event
    topic = getattr(other, "topic", None)
    return (
        topic is not None and not isinstance(other, Event) and str(topic) == received_topic(event)
    )


def _defers(place: Place, event: Event) -> bool:
    items = place.node.items if isinstance(place.node, (State, Parallel)) else []
    return any(
        each.event.target is event
        for item in items
        if isinstance(item, Defer)
        for each in item.events
    )
