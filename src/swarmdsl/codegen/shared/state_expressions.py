"""Expressions of states, and the states whose time of entry they need."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.ir import (
    Assignment,
    Effect,
    Elapsed,
    Expression,
    Send,
    State,
    StateMachine,
    TimeTrigger,
    subexpressions,
)


def timed_states(machine: StateMachine) -> frozenset[str]:
    """Return the ids of the states of which an expression asks how long they have been active."""
    return frozenset(
        part.state
        for state in machine.walk()
        for expression in expressions_of(state)
        for part in subexpressions(expression)
        if isinstance(part, Elapsed)
    )


def expressions_of(state: State) -> Iterator[Expression]:
    """Yield the expressions of a state, without the states inside."""
    yield from _of_effects(state.entry)
    if state.activity is not None:
        yield from (value for _, value in state.activity.arguments)
    for transition in state.transitions:
        yield from (t.delay for t in transition.triggers if isinstance(t, TimeTrigger))
        if transition.guard is not None:
            yield transition.guard
        yield from _of_effects(transition.effects)
    yield from _of_effects(state.exit)


def _of_effects(effects: Iterable[Effect]) -> Iterator[Expression]:
    for effect in effects:
        match effect:
            case Assignment(value=value):
                yield value
            case Send(arguments=arguments, to=to, delay=delay):
                yield from (value for _, value in arguments)
                yield from to.values if to is not None else ()
                if delay is not None:
                    yield delay
