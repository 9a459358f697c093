"""Checks of delays: of those that never elapse, and of those that look like a part of a `send`."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import inf

from swarmdsl.analysis.checks.context import Context
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    Entry,
    Exit,
    Parallel,
    Send,
    State,
    StateMachine,
    TimeTrigger,
    Transition,
    Trigger,
    nodes_of,
)

Leaving = tuple[float, Transition]
"""A transition that always leaves its state, and the nanoseconds that it waits."""


def leaves(transition: Transition) -> bool:
    """Return True if a transition ends all delays of its state."""
    return transition.target is not None and not transition.internal


def soonest_of(transitions: Sequence[Transition], context: Context) -> list[Leaving]:
    """Return the two transitions that always leave the state after the shortest delays."""
    found: list[Leaving] = []
    for transition in transitions:
        if transition.guard is None and leaves(transition):
            delays = _delays(transition, context)
            if delays:
                found.append((min(delays), transition))
    return sorted(found, key=lambda each: each[0])[:2]


def sooner_one(
    trigger: Trigger, transition: Transition, soonest: Sequence[Leaving], context: Context
) -> Transition | None:
    """Return a transition that always leaves the state no later than a trigger fires."""
    delay = _delay(trigger, context)
    others = ((sooner, other) for sooner, other in soonest if other is not transition)
    sooner, other = next(others, (inf, None))
    if delay is None or other is None:
        return None
    before = other.span.start < transition.span.start
    return other if sooner < delay or (before and sooner == delay) else None


def check_late(transition: Transition, outer: Leaving, context: Context) -> bool:
    """Report a transition whose outer state is always left before; return True if reported.

    The outer state was entered no later than the inner one.
    """
    soonest, before = outer
    delays = _delays(transition, context)
    if not delays or len(delays) < len(transition.triggers) or soonest > min(delays):
        return False
    context.report.report(
        "transition-never-fires",
        transition.span,
        related=(Label(before.span, "this one leaves the outer state no later"),),
        help="shorten this delay, or lengthen the other one",
    )
    return True


def _delays(transition: Transition, context: Context) -> list[float]:
    """Known delays of the triggers of a transition."""
    known = [_delay(trigger, context) for trigger in transition.triggers]
    return [delay for delay in known if delay is not None]


def _delay(trigger: Trigger, context: Context) -> float | None:
    """Delay of a trigger; None if it is unknown or invalid."""
    if isinstance(trigger, TimeTrigger) and trigger.delay.tree is not None:
        value = context.typing.folding.value(trigger.delay.tree)
        return value if isinstance(value, (int, float)) and value > 0 else None
    return None


def check_undelayed_sends(machine: StateMachine, context: Context) -> None:
    """Report `after` on a line below `send` and indented like a part of it, which it is not."""
    states: list[State | Parallel] = [*nodes_of(machine, State), *nodes_of(machine, Parallel)]
    for above, below in (pair for state in states for pair in pairwise(state.items)):
        sent = _sent_last(above)
        if sent is None or not isinstance(below, Transition):
            continue
        delay = below.triggers[0] if below.triggers else None
        if isinstance(delay, TimeTrigger) and _is_indented_below(above.span, delay.span):
            context.report.report(
                "undelayed-send",
                delay.span,
                event=sent.event.name,
                related=(Label(sent.span, "this is sent at once"),),
                help=Advice(
                    f"write `{sent.span.text} {delay.span.text}` on one line to delay it; "
                    "else indent this line like the one above",
                    "join lines",
                    f"{sent.span.text} {delay.span.text}",
                ),
            )


def _sent_last(item: object) -> Send | None:
    """Return the `send` that an item of a state ends in, if it could have a delay."""
    if not isinstance(item, (Entry, Exit, Transition)) or not item.effects:
        return None
    last = item.effects[-1]
    has_target = isinstance(item, Transition) and item.target is not None
    return last if isinstance(last, Send) and last.delay is None and not has_target else None


def _is_indented_below(above: Span, below: Span) -> bool:
    line, column = above.source.line_column(above.start)
    other_line, other_column = below.source.line_column(below.start)
    return other_line > line and other_column > column
