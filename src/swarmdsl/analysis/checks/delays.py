"""Delays that are too long: their state, or one around it, is always left before."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

from swarmdsl.analysis.checks.context import Context
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.syntax.ast import TimeTrigger, Transition, Trigger

Leaving = tuple[float, Transition]
"""A transition that always leaves its state, and the nanoseconds that it waits."""


def leaves(transition: Transition) -> bool:
    """Whether it ends all delays of its state."""
    return transition.target is not None and not transition.internal


def soonest_of(transitions: Sequence[Transition], context: Context) -> list[Leaving]:
    """The two transitions that leave the state always and first, as their time comes."""
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
    """The transition that leaves the state always, and after a shorter time or the same."""
    delay = _delay(trigger, context)
    others = ((sooner, other) for sooner, other in soonest if other is not transition)
    sooner, other = next(others, (inf, None))
    if delay is None or other is None:
        return None
    before = other.span.start < transition.span.start
    return other if sooner < delay or (before and sooner == delay) else None


def check_late(transition: Transition, outer: Leaving, context: Context) -> bool:
    """Report that the state around, which was entered no later, is left by then.

    Return whether it is.
    """
    soonest, before = outer
    delays = _delays(transition, context)
    if not delays or len(delays) < len(transition.triggers) or soonest > min(delays):
        return False
    context.report.report(
        "transition-never-fires",
        transition.span,
        related=(Label(before.span, "this one leaves the state around it no later"),),
        help="let it wait less long, or the other one longer",
    )
    return True


def _delays(transition: Transition, context: Context) -> list[float]:
    """How long those of its triggers wait of which that is known."""
    known = [_delay(trigger, context) for trigger in transition.triggers]
    return [delay for delay in known if delay is not None]


def _delay(trigger: Trigger, context: Context) -> float | None:
    """How long a trigger waits, where that is known and makes sense."""
    if isinstance(trigger, TimeTrigger) and trigger.delay.tree is not None:
        value = context.typing.folding.value(trigger.delay.tree)
        return value if isinstance(value, (int, float)) and value > 0 else None
    return None
