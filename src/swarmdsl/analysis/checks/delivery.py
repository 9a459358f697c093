"""Checks of the delivery of swarm events."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.delays import leaves
from swarmdsl.base.diagnostics.advice import Advice
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
    walk,
)
from swarmdsl.syntax.types import DURATION, INT

_WORDS = {"best": "best effort"}
_Beside = tuple[Parallel, Region, Sequence[object]]
"""A parallel state, the region of it that a state is in, and what is beside this region."""
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
            fault="it has no delivery",
            related=(Label(event.name.span, "this event stays on its robot"),),
            help=Advice(
                f"declare it as `swarm event {event.name}`, or leave the settings out",
                "swarm event",
            ),
        )
    by_kind: dict[str, list[DeliverySetting]] = {}
    for setting in event.delivery:
        by_kind.setdefault(setting.kind, []).append(setting)
        _check_value(setting, context)
    for kind, found in by_kind.items():
        context.check_single([each.span for each in found], f"`{_WORDS.get(kind, kind)}`")
    for other in ("reliable", "latest", "keep"):
        _check_contradiction(by_kind.get("best", []), by_kind.get(other, []), context)


def check_operator(event: Event, context: Context) -> None:
    """Check that an event that a person may send travels between robots."""
    if event.operator and not event.swarm:
        context.report.report(
            "local-delivery",
            event.name.span,
            name=event.name,
            fault="no operator sends it",
            help=Advice(f"declare it as `swarm operator event {event.name}`", "swarm event"),
        )


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
        help=Advice(
            "leave one of them out: only events that are sent again wait for a receiver",
            "leave out one",
        ),
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
    for item in machine.items:
        _check_state(item, (), context)


def _check_state(item: object, around: tuple[_Beside, ...], context: Context) -> None:
    """Check the transitions of a state and of those inside it; `around` are regions around it."""
    if isinstance(item, Parallel):
        for region in item.items:
            if isinstance(region, Region):
                others = [each for each in item.items if each is not region]
                for vertex in region.items:
                    _check_state(vertex, (*around, (item, region, others)), context)
    elif isinstance(item, State):
        for inside in item.items:
            _check_state(inside, around, context)
    if isinstance(item, (State, Parallel)):
        for transition in item.items:
            if isinstance(transition, Transition) and leaves(transition):
                ended = _ended(item, transition, around)
                if ended is not None:
                    _report_lossy(transition, ended, context)


def _ended(
    state: State | Parallel, transition: Transition, around: tuple[_Beside, ...]
) -> State | Parallel | None:
    """Return the composite state whose activities a transition ends: its own, or one around it."""
    own = [item for item in state.items if not isinstance(item, Activity)]
    if any(map(_has_activities, own)) or _runs_activities(state):
        return state
    target = transition.target.target if transition.target is not None else None
    for parallel, region, others in around:
        stays = target is None or any(node is target for node in walk(region))
        if not stays and any(map(_has_activities, others)):
            return parallel
    return None


def _report_lossy(transition: Transition, ended: State | Parallel, context: Context) -> None:
    for trigger in transition.triggers:
        event = trigger.event.target if isinstance(trigger, EventTrigger) else None
        if event is not None and any(each.kind == "best" for each in event.delivery):
            context.report.report(
                "lossy-event",
                trigger.span,
                name=event.name,
                state=ended.name,
                related=(Label(event.name.span, "its delivery is best effort"),),
                help=Advice("declare the event as `reliable`", "reliable", event.name.span),
            )


def _has_activities(item: object) -> bool:
    if isinstance(item, Activity):
        return True
    inner = item.items if isinstance(item, (State, Parallel, Region)) else ()
    return _runs_activities(item) or any(map(_has_activities, inner))


def _runs_activities(item: object) -> bool:
    """Return True for a submachine state with activities inside its machine."""
    if not isinstance(item, State) or item.machine is None or item.machine.target is None:
        return False
    return any(nodes_of(each, Activity) for each in _reused(item.machine.target, set()))


def _reused(machine: StateMachine, known: set[StateMachine]) -> set[StateMachine]:
    """Return a machine and those that it reuses; one that contains itself is an error."""
    if machine not in known:
        known.add(machine)
        for state in nodes_of(machine, State):
            if state.machine is not None and state.machine.target is not None:
                _reused(state.machine.target, known)
    return known
