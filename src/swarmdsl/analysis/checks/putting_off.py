"""Checks of deferred events and of delayed sends that are cancelled."""

from __future__ import annotations

from swarmdsl.analysis.checks.context import Context
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    Cancel,
    Defer,
    Event,
    EventTrigger,
    Parallel,
    Send,
    State,
    StateMachine,
    Transition,
    nodes_of,
)


def check_putting_off(machine: StateMachine, context: Context) -> None:
    """Check what a machine defers and cancels."""
    states: list[State | Parallel] = [*nodes_of(machine, State), *nodes_of(machine, Parallel)]
    for state in states:
        _check_deferred(state, context)
    _check_cancelled(machine, context)


def _check_deferred(state: State | Parallel, context: Context) -> None:
    """Report events that a state defers twice, and those that it always handles itself."""
    handled: dict[Event, Span] = {}
    for item in state.items:
        if isinstance(item, Transition) and item.guard is None:
            for trigger in item.triggers:
                if isinstance(trigger, EventTrigger) and trigger.event.target is not None:
                    handled.setdefault(trigger.event.target, trigger.span)
    first: dict[Event, Span] = {}
    for item in state.items:
        for ref in [each.event for each in item.events] if isinstance(item, Defer) else ():
            event = ref.target
            if event is None:
                continue
            if event in first:
                context.report.report(
                    "repeated-trigger",
                    ref.span,
                    trigger=ref.name,
                    related=(Label(first[event], "by this"),),
                    help=Advice("remove one of the two", "remove trigger"),
                )
            elif event in handled:
                context.report.report(
                    "needless-defer",
                    ref.span,
                    name=ref.name,
                    state=state.name,
                    related=(Label(handled[event], "the state always handles it here"),),
                    help=Advice("remove it, or give the transition a guard", "remove defer"),
                )
            first.setdefault(event, ref.span)


def _check_cancelled(machine: StateMachine, context: Context) -> None:
    """Report cancelled events that the machine never sends with a delay.

    A machine and those that it reuses cancel for each other.
    """
    if any(state.machine is not None for state in nodes_of(machine, State)):
        return
    delayed = {send.event.target for send in nodes_of(machine, Send) if send.delay is not None}
    for cancel in nodes_of(machine, Cancel):
        event = cancel.event.target
        if event is not None and event not in delayed:
            context.report.report(
                "nothing-to-cancel",
                cancel.event.span,
                name=cancel.event.name,
                help=Advice(
                    f"send it with a delay: `send {cancel.event.name} after 5 s`", "delay send"
                ),
            )
