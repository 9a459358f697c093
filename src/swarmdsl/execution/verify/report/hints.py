"""Hints at what could prevent a run: only where the run itself shows what is missing."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl import ir
from swarmdsl.execution.engine import Kind, Machine, State
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.verify.search.run import Run


def hint(run: Run) -> str | None:
    """Return a hint at the event that a robot ignores, or at the loss that none notices.

    In a run that goes on for ever, an ignored event may matter to nobody; in one after which
    nothing happens, any of several may.
    """
    if run.loop:
        return None
    ignored = [each for each in reversed(run.lines) if each.ignored and each.envelope.sender]
    if run.loop is not None and len({(each.actor, each.event) for each in ignored}) != 1:
        return None
    return _handling(ignored[0]) if ignored else _repeating(run)


def _handling(line: Line) -> str:
    """Return the hint for an event of another robot that is ignored."""
    event, where = line.event or "", line.configuration[-1]
    told = f"`{line.actor.name}` ignores `{event}` in `{where}`"
    for state in _active(line):
        for edge in state.transitions:
            origin = edge.origin
            if event in edge.events and isinstance(origin, ir.Transition) and origin.origin:
                place = origin.origin
                return f"{told}: the guard in {place.source.name}:{place.line} is false then"
    return f"{told}: handle it there with `on {event}`, or keep it with `defer {event}`"


def _repeating(run: Run) -> str | None:
    """Return the hint for a lost event whose sender waits without an end."""
    if not run.lost:
        return None
    at, event, _ = run.lost[-1]
    senders = {line.actor: line for line in run.lines[:at] if event in line.sent}
    if len(senders) != 1:
        return None
    (sender,) = senders
    last = next(line for line in reversed(run.lines) if line.actor is sender)
    states = list(_active(last))
    if any(state.kind is Kind.FINAL or _goes_on(state) for state in states):
        return None
    waits = last.configuration[-1]
    return f"`{sender.name}` waits in `{waits}`, though `{event}` is lost: add `after` a time there"


def _active(line: Line) -> Iterator[State]:
    """Yield the states in which a machine is after a line, the inner ones first."""
    machine: Machine = line.actor.machine
    for name in line.configuration:
        place = machine.numbers[name]
        for each in (place, *machine.ancestors(place)):
            yield machine.states[each]


def _goes_on(state: State) -> bool:
    """Return True if something happens by itself in a state."""
    edges = (edge.origin for edge in state.transitions)
    return state.activity is not None or any(
        isinstance(trigger, ir.TimeTrigger)
        for edge in edges
        if isinstance(edge, ir.Transition)
        for trigger in edge.triggers
    )
