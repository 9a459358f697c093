"""Internal transitions of a parallel state into one of its regions.

SCXML has internal transitions of compound states only, so each moves to the region that it
leads into. In the parallel state a transition without content remains, which keeps those
after it from being taken.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import reduce

from swarmdsl.codegen.shared.events import Events
from swarmdsl.ir import Binary, Expression, Literal, State, StateKind, Transition, Unary
from swarmdsl.syntax.types import BOOL


def entered_region(transition: Transition, state: State) -> State | None:
    """Return the region that an internal transition of a parallel state enters."""
    if state.kind is not StateKind.PARALLEL or not transition.internal:
        return None
    target = f"{transition.target}."
    return next((region for region in state.states if target.startswith(f"{region.id}.")), None)


def region_transitions(
    region: State, around: State, events: Events
) -> Iterator[tuple[str, Expression | None, Transition, int]]:
    """Yield the transitions that move to a region: event, guard, transition, index.

    The event is empty if there is none; the index is among the transitions of the parallel state.
    A region takes its own transitions before those of the parallel state, so the guards exclude
    the earlier ones there.
    """
    if not any(each.internal for each in around.transitions):
        return
    # By event: the negated guards of the earlier transitions.
    refused: dict[str, list[Expression]] = {}
    for index, transition in enumerate(around.transitions):
        triggers = events.of_transition(transition, around)
        if entered_region(transition, around) is region:
            for event in triggers:
                # One that is never taken is written too: importing the document restores it.
                guard = _all(refused.get(event, ()), transition.guard)
                yield event, guard, transition, index
        for event in dict.fromkeys(triggers):
            negated = Unary("not", transition.guard or Literal(True, BOOL), BOOL)
            refused.setdefault(event, []).append(negated)


def _all(guards: Iterable[Expression], last: Expression | None) -> Expression | None:
    """Return the conjunction of guards; None if there is none."""
    given = [*guards, *([last] if last is not None else [])]
    return reduce(lambda left, right: Binary("and", left, right, BOOL), given) if given else None
