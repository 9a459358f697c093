"""Traversal of the effects of a machine."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.ir import Effect, StateMachine


def effects_of(machine: StateMachine) -> Iterator[Effect]:
    """Yield all effects: of transitions, on entry and on exit."""
    for state in machine.walk():
        yield from state.entry
        yield from state.exit
        for transition in state.transitions:
            yield from transition.effects
