"""Internal transitions of a parallel state that lead into one of its regions.

SCXML has internal transitions of compound states only, so each stands in the region that it
leads into. What remains of it in the parallel state does nothing, and keeps those after it
from being taken.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import reduce

from swarmdsl.codegen.shared.events import Events
from swarmdsl.ir import Binary, Expression, Literal, State, StateKind, Transition, Unary
from swarmdsl.syntax.types import BOOL


def entered_region(transition: Transition, state: State) -> State | None:
    """The region that an internal transition of a parallel state leads into."""
    if state.kind is not StateKind.PARALLEL or not transition.internal:
        return None
    target = f"{transition.target}."
    return next((region for region in state.states if target.startswith(f"{region.id}.")), None)


def region_transitions(
    region: State, around: State, events: Events
) -> Iterator[tuple[str, Expression | None, Transition, int]]:
    """What such a region takes itself: the event, empty for none, the guard, the transition, which.

    The last is the number of the transition among those of the parallel state.

    A region takes its own before those of the parallel state: the earlier ones there must not
    be enabled.
    """
    for index, transition in enumerate(around.transitions):
        if entered_region(transition, around) is not region:
            continue
        for event in events.of_transition(transition, around):
            # One that is never taken is written too: it comes back when the document is read.
            refused = [
                Unary("not", earlier.guard or Literal(True, BOOL), BOOL)
                for earlier in around.transitions[:index]
                if event in events.of_transition(earlier, around)
            ]
            yield event, _all(refused, transition.guard), transition, index


def _all(guards: Iterable[Expression], last: Expression | None) -> Expression | None:
    """The conjunction of guards; None when there is none."""
    given = [*guards, *([last] if last is not None else [])]
    return reduce(lambda left, right: Binary("and", left, right, BOOL), given) if given else None
