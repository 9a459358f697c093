"""Outcomes of an activity that a state does not handle yet."""

from __future__ import annotations

from swarmdsl.ide.server.candidates import containers
from swarmdsl.syntax.ast import (
    Activity,
    OutcomeTrigger,
    State,
    StateMachine,
    TopLevel,
    Transition,
)

_ALL = ("succeeded", "aborted", "preempted")


def unhandled_outcomes(owner: TopLevel | None, offset: int) -> list[str]:
    """Return the outcomes that no unguarded transition of the state at an offset handles.

    The transition at the offset itself does not count. Returns all outcomes if the state is
    unknown.
    """
    if not isinstance(owner, StateMachine):
        return list(_ALL)
    state = containers(owner, offset)[-1]
    if not isinstance(state, State):
        return [] if state is not owner else list(_ALL)
    if not any(isinstance(item, Activity) for item in state.items):
        return []
    taken: set[str] = set()
    for item in state.items:
        if isinstance(item, Transition) and item.guard is None:
            _, start, end = item.span.absolute
            if not start <= offset <= end:
                # A trigger without text is not typed yet.
                triggers = (each for each in item.triggers if each.span.text)
                taken.update(each.outcome for each in triggers if isinstance(each, OutcomeTrigger))
    return [each for each in _ALL if each not in taken]
