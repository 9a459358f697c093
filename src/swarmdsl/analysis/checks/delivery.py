"""Checks of the delivery of swarm events."""

from __future__ import annotations

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.delays import leaves
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.syntax.ast import (
    Activity,
    DeliverySetting,
    Event,
    EventTrigger,
    Parallel,
    Region,
    State,
    StateMachine,
    Transition,
    nodes_of,
)
from swarmdsl.syntax.types import DURATION, INT

_WORDS = {"best": "best effort"}
MOST_KEPT = 2**31 - 1
"""Largest depth of a queue in ROS."""


def check_delivery(event: Event, context: Context) -> None:
    """Check that an event has a delivery only between robots, and that its settings agree."""
    if not event.delivery:
        return
    if not event.swarm:
        context.report.report(
            "local-delivery",
            event.delivery[0].span,
            name=event.name,
            related=(Label(event.name.span, "this event stays on its robot"),),
            help=f"declare it as `swarm event {event.name}`, or leave the settings out",
        )
    by_kind: dict[str, list[DeliverySetting]] = {}
    for setting in event.delivery:
        by_kind.setdefault(setting.kind, []).append(setting)
        _check_value(setting, context)
    for kind, found in by_kind.items():
        context.check_single([each.span for each in found], f"`{_WORDS.get(kind, kind)}`")
    for other in ("reliable", "latest", "keep"):
        _check_contradiction(by_kind.get("best", []), by_kind.get(other, []), context)


def _check_value(setting: DeliverySetting, context: Context) -> None:
    """Check the number of `keep`, or a time."""
    if setting.value is None or setting.value.tree is None:
        return
    is_count = setting.kind == "keep"
    context.check_constant(setting.value, INT if is_count else DURATION)
    value = context.typing.folding.value(setting.value.tree)
    if not isinstance(value, (int, float)):
        return
    if value < 1:
        least = "1" if is_count else "1 us"
        context.report.report(
            "impossible-setting", setting.value.span, name=setting.kind, least=least
        )
    elif is_count and value > MOST_KEPT:
        context.report.report(
            "contradictory-delivery",
            setting.value.span,
            fault=f"no queue keeps more than {MOST_KEPT} events",
        )


def _check_contradiction(
    one: list[DeliverySetting], other: list[DeliverySetting], context: Context
) -> None:
    """Report the later of two settings that exclude each other."""
    if not one or not other:
        return
    places = sorted((one[0], other[0]), key=lambda each: each.span.start)
    context.report.report(
        "contradictory-delivery",
        places[1].span,
        fault=f"an event is either `{_word(places[0])}` or `{_word(places[1])}`",
        related=(Label(places[0].span, "the other one"),),
        help="leave one of them out: only events that are sent again wait for a receiver",
    )


def _word(setting: DeliverySetting) -> str:
    return _WORDS.get(setting.kind, setting.kind)


def check_lossy_events(machine: StateMachine, context: Context) -> None:
    """Report best effort events that end the activities of a composite state.

    Such an event is often there for safety. The check is off by default, because only the network
    decides how much is lost.
    """
    if not context.report.wants("lossy-event"):
        return
    states: list[State | Parallel] = [*nodes_of(machine, State), *nodes_of(machine, Parallel)]
    for state in states:
        if not any(_has_activities(item) for item in state.items if not isinstance(item, Activity)):
            continue
        for transition in state.items:
            if not isinstance(transition, Transition) or not leaves(transition):
                continue
            for trigger in transition.triggers:
                event = trigger.event.target if isinstance(trigger, EventTrigger) else None
                if event is not None and any(each.kind == "best" for each in event.delivery):
                    context.report.report(
                        "lossy-event",
                        trigger.span,
                        name=event.name,
                        state=state.name,
                        related=(Label(event.name.span, "its delivery is best effort"),),
                        help="declare the event as `reliable`",
                    )


def _has_activities(item: object) -> bool:
    if isinstance(item, Activity):
        return True
    inner = item.items if isinstance(item, (State, Parallel, Region)) else ()
    return any(map(_has_activities, inner))
